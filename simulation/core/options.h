// The options protocol: a stage's options are one struct whose Visit lists each field once, as
//   v(name, field, range, unit, help)
// JSON, command line, panel and manual all read that list. Fields are double, int, bool,
// std::string or an enum. In memory lengths are metres ("m") and angles radians ("rad"); a visitor
// converts at its border: JSON writes "rad" fields in degrees under a key that ends in _deg, and
// the command line and the panels show "m" as millimetres (--name-mm) and "rad" as degrees
// (--name-deg).
#pragma once

#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "simulation/core/units.h"

namespace arthro {

struct Range {  // inclusive, in the unit of the field in memory
  double min, max;
};

struct Any {};  // every value of the type will do

template <class E>
struct Choices {  // the words of an enum, in the order in which a person should see them
  std::vector<std::pair<E, const char*>> words;
};

// How a field appears outside memory: shown value = value * factor, name + suffix.
struct Border {
  double factor = 1.0;
  const char* suffix = "";
};

inline Border FileBorder(std::string_view unit) {
  if (unit == "rad") return {1.0 / kRadianPerDegree, "_deg"};
  return {};
}

inline Border PersonBorder(std::string_view unit) {
  if (unit == "rad") return {1.0 / kRadianPerDegree, "_deg"};
  if (unit == "m") return {1.0 / kMetrePerMillimetre, "_mm"};
  return {};
}

// Throws Error(kBadArgument) that names the first field outside its range.
template <class Options>
void CheckOptions(const Options& options);

}  // namespace arthro

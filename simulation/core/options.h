// Options protocol: the options of a stage are one struct whose Visit lists each field once, as
//   v(name, field, rule, unit, help)
// JSON, command line, panels and schema all read that list. Fields of options are double, int,
// bool, std::string or an enum; a scene also has paths, points, rotations, nested structs and lists
// (simulation/scene/json/field_json.h). In memory lengths are metres ("m") and angles radians
// ("rad"). A visitor converts at its border: JSON writes "rad" fields in degrees under a key that
// ends in _deg; command line and panels show "m" as millimetres (--name-mm) and "rad" as degrees
// (--name-deg).
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "simulation/core/units.h"

namespace arthro {

// Closed range in the unit of the field in memory; `above_min` excludes the lower end.
struct Range {
  double min, max;
  bool above_min = false;
};

constexpr bool Contains(const Range& range, double value) {  // false for NaN
  return value <= range.max && (range.above_min ? value > range.min : value >= range.min);
}

struct Any {};  // every value of the type is allowed

template <class E>
struct Choices {  // the words of an enum, in the order in which a person should see them
  std::vector<std::pair<E, const char*>> words;
};

// Rules that only fields of files need. Each wraps the rule of the value itself.
template <class Rule>
struct Required {  // must be in the file; a text must not be empty
  Rule rule;
};
template <class Rule>
struct Always {  // written even while the text is empty
  Rule rule;
};
template <class T, class Rule>
struct LeftOutAt {  // not written while the field has this value
  T value;
  Rule rule;
};
template <class Rule>
struct OnlyIf {  // belongs to the struct only while `holds`
  bool holds;
  Rule rule;
};
// Clang 14, by which clang-tidy reads the sources, deduces no arguments of aggregates without them.
template <class Rule>
Required(Rule) -> Required<Rule>;
template <class Rule>
Always(Rule) -> Always<Rule>;
template <class T, class Rule>
LeftOutAt(T, Rule) -> LeftOutAt<T, Rule>;
template <class Rule>
OnlyIf(bool, Rule) -> OnlyIf<Rule>;

// Finds the rule, unit and help of one field by its name.
struct FieldFinder {
  std::string_view wanted;
  Range range{0, 0};
  std::string unit = {}, help = {};
  bool is_found = false;

  template <class T, class Rule>
  void operator()(std::string_view name, T&, const Rule& rule, const char* its_unit,
                  const char* its_help) {
    if (name != wanted) return;
    if constexpr (requires { rule.rule; }) {
      if constexpr (std::is_same_v<std::decay_t<decltype(rule.rule)>, Range>) range = rule.rule;
    } else if constexpr (std::is_same_v<Rule, Range>) {
      range = rule;
    }
    unit = its_unit;
    help = its_help;
    is_found = true;
  }
};

// The field `name` of Options as its Visit lists it. A misspelt name throws std::out_of_range.
template <class Options>
FieldFinder FindField(std::string_view name) {
  FieldFinder finder{name};
  Options().Visit(finder);
  if (!finder.is_found) throw std::out_of_range("no field " + std::string(name));
  return finder;
}

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

}  // namespace arthro

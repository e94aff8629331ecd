#include "simulation/scope/disturbances.h"

#include <charconv>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "simulation/core/error.h"
#include "simulation/core/option_fields.h"

namespace arthro::simulation {

std::array<double, kDisturbances> StrengthsOf(Disturbances disturbances) noexcept {
  std::array<double, kDisturbances> strengths{};
  std::size_t next = 0;
  disturbances.Visit([&](const char*, double& strength, const Range&, const char*, const char*) {
    strengths.at(next++) = strength;
  });
  return strengths;
}

Disturbances DisturbancesOf(const std::array<double, kDisturbances>& strengths, int seed) noexcept {
  Disturbances disturbances;
  std::size_t next = 0;
  disturbances.Visit([&](const char*, double& strength, const Range&, const char*, const char*) {
    strength = strengths.at(next++);
  });
  disturbances.seed = seed;
  return disturbances;
}

void CheckDisturbances(const Disturbances& disturbances) {
  CheckOptions(disturbances);
  if (!std::isfinite(disturbances.time))
    throw Error(
        Code::kBadArgument,
        fmt::format("the disturbances' time is {}; give a number of seconds", disturbances.time));
}

namespace {

struct Strength {
  std::string name, text;
  bool is_taken = false;
};

// Splits "name=number" pieces at commas.
std::vector<Strength> PiecesOf(std::string_view list) {
  std::vector<Strength> pieces;
  while (true) {
    const std::string_view piece = list.substr(0, list.find(','));
    const auto equals = piece.find('=');
    if (equals == std::string_view::npos)
      throw Error(Code::kBadArgument,
                  fmt::format("\"{}\" is no disturbance; write name=strength, as in haze=0.5,fog=1",
                              piece));
    pieces.push_back({std::string(piece.substr(0, equals)), std::string(piece.substr(equals + 1))});
    if (piece.size() == list.size()) return pieces;
    list.remove_prefix(piece.size() + 1);
  }
}

struct StrengthReader {
  std::vector<Strength>& pieces;
  std::string names;

  void operator()(const char* name, double& field, const Range& range, const char*, const char*) {
    names += (names.empty() ? "" : ", ") + std::string(name);
    for (Strength& piece : pieces) {
      if (piece.name != name || piece.is_taken) continue;
      const char* end = piece.text.data() + piece.text.size();
      const auto read = std::from_chars(piece.text.data(), end, field);
      // NaN is in no range.
      if (read.ec != std::errc() || read.ptr != end || !(field >= range.min && field <= range.max))
        throw Error(Code::kBadArgument, fmt::format("disturbance {} is {}; it must be between {} "
                                                    "and {}",
                                                    name, piece.text, range.min, range.max));
      piece.is_taken = true;
      break;
    }
  }
};

}  // namespace

Disturbances ParseDisturbances(std::string_view list) {
  Disturbances disturbances;
  std::vector<Strength> pieces = PiecesOf(list);
  StrengthReader reader{pieces, {}};
  disturbances.Visit(reader);
  for (const Strength& piece : pieces)
    if (!piece.is_taken)
      throw Error(Code::kBadArgument,
                  fmt::format("disturbance \"{}\" is not known or named twice; there are {}",
                              piece.name, reader.names));
  return disturbances;
}

std::string DisturbanceHelp() {
  struct Words {
    std::string all;
    void operator()(const char* name, double&, const Range&, const char*, const char* help) {
      const std::string_view words(help);
      all += fmt::format("{}{} ({})", all.empty() ? "" : "; ", name,
                         words.substr(0, words.size() - 1));
    }
  } words;
  Disturbances().Visit(words);
  return words.all;
}

}  // namespace arthro::simulation

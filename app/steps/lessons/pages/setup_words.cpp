#include "app/steps/lessons/pages/setup_words.h"

#include <vector>

#include <fmt/format.h>

#include "simulation/core/units.h"

namespace arthro::app {
namespace {

// "a, b or c"
std::string Alternatives(const std::vector<std::string>& words) {
  std::string all;
  for (std::size_t i = 0; i < words.size(); ++i)
    all += (i == 0 ? "" : i + 1 == words.size() ? " or " : ", ") + words[i];
  return all;
}

}  // namespace

std::string SetupWords(const ExerciseSetup& setup) {
  std::vector<std::string> angles, parts;
  for (const double angle : setup.view_angles)
    angles.push_back(fmt::format("{:.0f}°", DegreesFromRadians(angle)));
  if (!angles.empty()) parts.push_back(fmt::format("Scope: {}", Alternatives(angles)));
  if (!setup.instruments.empty())
    parts.push_back(fmt::format("Instrument: {}", Alternatives(setup.instruments)));
  if (setup.head != HeadChoice::kAny)
    parts.push_back(setup.head == HeadChoice::kUpright ? "Camera head: upright"
                                                       : "Camera head: with the scope");
  std::string words;
  for (const std::string& part : parts) words += (words.empty() ? "" : "   ") + part;
  return words;
}

}  // namespace arthro::app

#include "app/cli/flags/ball_flag.h"

#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/cli/flags/number_flags.h"
#include "simulation/core/units.h"

namespace arthro::app {

Ball BallFromWords(const std::string& flag, const std::string& words) {
  const std::vector<double> mm = NumbersFromWord(flag, words, {{-1e4, 1e4}, "mm"});
  if (mm.size() != 4 || !(mm[3] > 0))
    throw CLI::ValidationError(
        flag, fmt::format("{} is not X,Y,Z,R: a centre and a radius of more than 0, in mm", words));
  return {kMetrePerMillimetre * glm::dvec3(mm[0], mm[1], mm[2]), MetresFromMm(mm[3])};
}

}  // namespace arthro::app

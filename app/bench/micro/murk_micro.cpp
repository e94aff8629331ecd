// Murk of the fluid, which each frame with haze pays for.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "app/bench/micro/micro_bench.h"
#include "app/view/disturbances/murk_field.h"
#include "tests/support/view/slow_murk.h"

namespace arthro::app {
namespace {

constexpr int kSeed = 3;
constexpr double kTime = 12.3;  // s

glm::dvec2 PlaceOf(int i, int j) { return {(i + 0.5) / kMurkSize, (j + 0.5) / kMurkSize}; }

MicroError WorstLevel() {
  const std::vector<std::uint8_t> field = MurkField(kSeed, kTime);
  double worst = 0;
  for (int j = 0; j < kMurkSize; ++j)
    for (int i = 0; i < kMurkSize; ++i) {
      const auto wanted = test::SlowMurk(kSeed, kTime, PlaceOf(i, j));
      for (std::size_t c = 0; c < wanted.size(); ++c) {
        const auto at = 4 * static_cast<std::size_t>(j * kMurkSize + i) + c;
        worst = std::max(worst, std::abs(field[at] - 255 * wanted[c]));
      }
    }
  return {worst, fmt::format("{:.2f} levels", worst)};
}

}  // namespace

MicroGroup MurkMicro(bool) {
  MicroGroup group{"murk", "worst difference, levels of 255", "each place in double precision", {}};
  group.functions.push_back({fmt::format("{0} x {0} texels of a moment", kMurkSize),
                             [] { KeepAlive(MurkField(kSeed, kTime)); }, WorstLevel});
  group.functions.push_back({"the same, each place in double precision",
                             [] {
                               for (int j = 0; j < kMurkSize; ++j)
                                 for (int i = 0; i < kMurkSize; ++i)
                                   KeepAlive(test::SlowMurk(kSeed, kTime, PlaceOf(i, j)));
                             },
                             {}});
  return group;
}

}  // namespace arthro::app

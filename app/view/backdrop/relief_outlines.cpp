#include "app/view/backdrop/relief_outlines.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <thread>
#include <vector>

namespace arthro::app {
namespace {

constexpr float kLeastJump =
    1.5e-4f;  // m between neighbouring texels; smaller steps show no staircase

// Depth of the silhouette below the near part, m, and as a share of a low step: less than can be
// told from the relief itself (`bench view` counts ends that are 0.1 mm off).
constexpr double kCrestDrop = 8e-5, kMostDrop = 0.05;

// Standard deviations of the difference of two texels that a step has to exceed. Noise exceeds five
// in one of two million pairs.
constexpr float kStepsOfError = 5.0f;

// Least height of a step between two texels, by their standard errors.
float LeastStep(const DepthMap& sigma, std::size_t a, std::size_t b) {
  if (sigma.empty()) return kLeastJump;
  const float error = kStepsOfError * std::hypot(sigma.relief[a], sigma.relief[b]);
  return error > kLeastJump ? error : kLeastJump;  // also where the error is not known (NaN)
}

// False for almost all texels, whose standard errors need not be looked at. A step to an unknown
// texel (NaN) is none.
bool CanBeStep(float a, float b) { return std::abs(b - a) >= kLeastJump; }

// Returns how much higher `b` is than `a` when that is an outline, else 0: before and after it the
// relief changes by less than half as much. Unknown texels are no outline.
float StepOf(float before, float a, float b, float after, float least) {
  const float step = b - a, most = 0.5f * std::abs(step);
  const bool is = 2 * most >= least && std::isfinite(most) && std::abs(a - before) < most &&
                  std::abs(after - b) < most;
  return is ? step : 0.0f;
}

// Steps of a map across its rows, or across its columns. `along` runs along such an outline; the
// step of (along, across) lies between across and across + 1.
struct Steps {
  int along = 0, across = 0;
  std::size_t to_next_along = 0, to_next_across = 0;  // texels
  bool along_wraps = false, across_wraps = false;
  std::vector<float> values;
  std::vector<std::vector<int>> found =
      {};  // per `across`: the places along it that have a step, ascending

  std::size_t Texel(int i, int j) const {
    if (along_wraps) i = (i + along) % along;
    if (across_wraps) j = (j + across) % across;
    return static_cast<std::size_t>(i) * to_next_along +
           static_cast<std::size_t>(j) * to_next_across;
  }
  float at(int i, int j) const {
    const bool is_inside =
        (along_wraps || (i >= 0 && i < along)) && (across_wraps || (j >= 0 && j < across));
    return is_inside ? values[Texel(i, j)] : 0.0f;
  }
};

Steps StepsAcrossRows(const DepthMap& map, bool whole_turn, const DepthMap& sigma) {
  Steps steps{map.width, map.height, 1, static_cast<std::size_t>(map.width), whole_turn, false, {}};
  steps.values.resize(map.relief.size(), 0.0f);
  steps.found.resize(static_cast<std::size_t>(map.height));
  for (int y = 1; y + 2 < map.height; ++y) {
    const float* row = &map.relief[steps.Texel(0, y)];
    const float *above = row - map.width, *below = row + map.width, *next = below + map.width;
    float* to = &steps.values[steps.Texel(0, y)];
    for (int x = 0; x < map.width; ++x) {
      if (!CanBeStep(row[x], below[x])) continue;
      to[x] = StepOf(above[x], row[x], below[x], next[x],
                     LeastStep(sigma, steps.Texel(x, y), steps.Texel(x, y + 1)));
      if (to[x] != 0) steps.found[static_cast<std::size_t>(y)].push_back(x);
    }
  }
  return steps;
}

Steps StepsAcrossColumns(const DepthMap& map, bool whole_turn, const DepthMap& sigma) {
  const int width = map.width;
  Steps steps{map.height, width, static_cast<std::size_t>(width), 1, false, whole_turn, {}};
  steps.values.resize(map.relief.size(), 0.0f);
  steps.found.resize(static_cast<std::size_t>(width));
  for (int y = 0; y < map.height; ++y) {
    const float* row = &map.relief[steps.Texel(y, 0)];
    float* to = &steps.values[steps.Texel(y, 0)];
    const auto take = [&](int x, float step) {
      to[x] = step;
      if (step != 0) steps.found[static_cast<std::size_t>(x)].push_back(y);
    };
    const auto least = [&](int x) {
      return LeastStep(sigma, steps.Texel(y, x), steps.Texel(y, (x + 1) % width));
    };
    for (int x = 1; x + 2 < width; ++x)
      if (CanBeStep(row[x], row[x + 1]))
        take(x, StepOf(row[x - 1], row[x], row[x + 1], row[x + 2], least(x)));
    if (!whole_turn || width < 4) continue;
    for (const int x : {0, width - 2, width - 1})
      take(x, StepOf(row[(x + width - 1) % width], row[x], row[(x + 1) % width],
                     row[(x + 2) % width], least(x)));
  }
  return steps;
}

bool AreOfOneOutline(float step, float other) {
  return step * other > 0 && std::abs(other) > 0.5f * std::abs(step) &&
         std::abs(step) > 0.5f * std::abs(other);
}

// Result: the new relief, and per texel the length of the tread that it comes from, since a texel
// at a corner lies on two.
struct Laid {
  const DepthMap& stairs;
  DepthMap& relief;
  std::vector<int> lengths;
};

// Shares of the near height in the two texels beside an outline, which is `way` texels from the
// near one. Bilinear interpolation then falls through the middle of the step at the outline, and to
// `drop` (a share of the step) below the near part at a constant distance before: where the lens
// looks over the near part, its silhouette lies there.
struct Ramp {
  double near = 1, far = 0;
};
Ramp RampAt(double way, double drop) {
  // The fall begins at the texel before the near one; either share alone holds one of the places.
  constexpr double kForCrest = 0.4;  // weight where the two differ
  const double for_crest = std::max(0.5, 1 - drop / (way + drop));
  const double for_middle = way < 0.5 ? 0.5 / (1 - way) : 1.0;
  Ramp ramp;
  ramp.near = way < 0.5 ? kForCrest * for_crest + (1 - kForCrest) * for_middle : for_crest;
  ramp.far = way > 0 ? std::max(0.0, ramp.near - (ramp.near - 0.5) / way) : 0.0;
  return ramp;
}

// A tread of `length` steps from `first` on.
void LayTread(const Steps& steps, int first, int length, int across, Laid& laid) {
  const auto goes_on = [&](int i, float from) {
    return AreOfOneOutline(from, steps.at(i, across + 1))   ? 1
           : AreOfOneOutline(from, steps.at(i, across - 1)) ? -1
                                                            : 0;
  };
  const int before = goes_on(first - 1, steps.at(first, across));
  const int after = goes_on(first + length, steps.at(first + length - 1, across));
  if (before == 0 && after == 0) return;
  const bool is_straight = before != 0 && after == -before;
  for (int i = 0; i < length; ++i) {
    // Offset of the outline from the middle of the step.
    const double place = (i + 0.5) / length, from_middle = 2 * place - 1;
    const int by = from_middle < 0 ? before : after;
    // Straight from half a texel to half a texel. For a crest, or an unknown continuation, to 0 in
    // the middle.
    const double offset =
        is_straight ? after * (place - 0.5) : 0.5 * by * from_middle * from_middle;
    const std::size_t texels[] = {steps.Texel(first + i, across),
                                  steps.Texel(first + i, across + 1)};
    const float heights[] = {laid.stairs.relief[texels[0]], laid.stairs.relief[texels[1]]};
    const int near = heights[0] > heights[1] ? 0 : 1;
    const double height = std::abs(double(heights[0]) - heights[1]);
    const Ramp ramp = RampAt(std::clamp(0.5 + (near == 0 ? offset : -offset), 0.0, 1.0),
                             std::min(kMostDrop, kCrestDrop / height));
    for (const int side : {0, 1}) {
      if (laid.lengths[texels[side]] >= length) continue;
      laid.lengths[texels[side]] = length;
      const auto share = static_cast<float>(side == near ? ramp.near : ramp.far);
      laid.relief.relief[texels[side]] = share * heights[near] + (1 - share) * heights[1 - near];
    }
  }
}

void LayTreads(const Steps& steps, Laid& laid) {
  for (int j = 0; j < steps.across; ++j) {
    const std::vector<int>& found = steps.found[static_cast<std::size_t>(j)];
    const std::size_t count = found.size();
    const auto joins = [&](int i) { return AreOfOneOutline(steps.at(i - 1, j), steps.at(i, j)); };
    // Around a full turn, beginning where a tread begins.
    std::size_t begin = 0;
    while (steps.along_wraps && begin < count && joins(found[begin])) ++begin;
    for (std::size_t done = 0; done < count;) {
      const int first = found[(begin + done) % count];
      int length = 1;
      while (done + static_cast<std::size_t>(length) < count && joins(first + length)) ++length;
      LayTread(steps, first, length, j, laid);
      done += static_cast<std::size_t>(length);
    }
  }
}

}  // namespace

void SmoothOutlines(DepthMap& relief, bool whole_turn, const DepthMap& sigma) {
  const DepthMap stairs = relief;
  Laid laid{stairs, relief, std::vector<int>(stairs.relief.size(), 0)};
  Steps across_rows, across_columns;
  {
    const std::jthread other(
        [&] { across_columns = StepsAcrossColumns(stairs, whole_turn, sigma); });
    across_rows = StepsAcrossRows(stairs, whole_turn, sigma);
  }
  LayTreads(across_rows, laid);
  LayTreads(across_columns, laid);
}

}  // namespace arthro::app

#include "app/view/backdrop/relief_outlines.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace arthro::app {
namespace {

constexpr float kLeastStep = 1.5e-4f;  // m, of a texel to the next; less shows no teeth
constexpr int kLongest = 64;           // texels that a stair is followed to either side

// A map as seen along an outline: `along` its texels and `across` them, which are columns and rows
// or the other way round.
struct Lines {
  const DepthMap& map;
  bool is_turned, wraps;
  float at(int along, int across) const {
    int x = is_turned ? across : along, y = is_turned ? along : across;
    if (wraps) x = (x + map.width) % map.width;
    return x < 0 || y < 0 || x >= map.width || y >= map.height ? NAN : map.at(x, y);
  }
  // How much higher the texel after `across` is than that at it, where that is an outline; else 0.
  float step(int along, int across) const {
    const float step = at(along, across + 1) - at(along, across);
    const float most = 0.5f * std::abs(step);
    if (!(2 * most >= kLeastStep && std::isfinite(most))) return 0;  // or unknown
    const float before = at(along, across) - at(along, across - 1);
    const float after = at(along, across + 2) - at(along, across + 1);
    return std::abs(before) < most && std::abs(after) < most ? step : 0;
  }
};

// Where a stair's tread ends to one side: after `length` texels, where the stair goes on `by`
// texels across (0: it is not known where it goes).
struct End {
  int length = 1, by = 0;
};
End Follow(const Lines& lines, int along, int across, float step, int direction) {
  const auto goes_on = [&](int i, int j) {
    const float other = lines.step(i, j);
    return other * step > 0 && std::abs(other) > 0.5f * std::abs(step);
  };
  End end;
  for (; end.length <= kLongest; ++end.length) {
    const int i = along + direction * end.length;
    if (goes_on(i, across)) continue;
    end.by = goes_on(i, across + 1) ? 1 : goes_on(i, across - 1) ? -1 : 0;
    break;
  }
  return end;
}

// How far the outline lies after the middle of two texels with a step between them, and how long
// the tread is on which they are.
struct Outline {
  double offset = 0, slope = 0;
  int length = 0;
};
Outline FindOutline(const Lines& lines, int along, int across, float step) {
  const End a = Follow(lines, along, across, step, -1), b = Follow(lines, along, across, step, 1);
  // From the tread's one end to its other in texels, and where these two are on it.
  const double length = a.length + b.length - 1, place = a.length - 0.5;
  Outline outline;
  outline.length = a.length + b.length - 1;
  if (a.by != 0 && b.by == -a.by) {
    outline.slope = b.by / length;
    outline.offset = 0.5 * a.by + outline.slope * place;
  } else if (a.by != 0 || b.by != 0) {
    // A crest, or an end: from half a texel at the side where it goes on to none in the middle.
    const double half = 0.5 * length;
    const double from_middle = place / half - 1;
    const int by = from_middle < 0 ? a.by : b.by;
    outline.offset = 0.5 * by * from_middle * from_middle;
    outline.slope = by * from_middle / half;
  }
  return outline;
}

// Whether one of the four beside a texel is a step away; that is all that most texels need.
bool IsBesideAStep(const DepthMap& map, int x, int y, bool wraps) {
  const float own = map.at(x, y);
  const auto is_step = [&](int u, int v) { return std::abs(map.at(u, v) - own) >= kLeastStep; };
  const int last = map.width - 1;
  const int left = x > 0 ? x - 1 : wraps ? last : 0, right = x < last ? x + 1 : wraps ? 0 : last;
  return is_step(left, y) || is_step(right, y) || is_step(x, std::max(y - 1, 0)) ||
         is_step(x, std::min(y + 1, map.height - 1));
}

float Smoothed(const std::array<Lines, 2>& directions, int x, int y) {
  float value = directions[0].map.at(x, y);
  int longest = 0;
  for (const Lines& lines : directions) {
    const int along = lines.is_turned ? y : x, across = lines.is_turned ? x : y;
    for (const int first : {across - 1, across}) {
      const float step = lines.step(along, first);
      if (step == 0) continue;
      const Outline outline = FindOutline(lines, along, first, step);
      if (outline.length <= longest) continue;
      longest = outline.length;
      const double beyond =
          (across - (first + 0.5 + outline.offset)) / std::sqrt(1 + outline.slope * outline.slope);
      const auto after = static_cast<float>(std::clamp(0.5 + beyond, 0.0, 1.0));  // share of it
      value = (1 - after) * lines.at(along, first) + after * lines.at(along, first + 1);
    }
  }
  return value;
}

}  // namespace

void SmoothOutlines(DepthMap& relief, bool whole_turn) {
  const DepthMap stairs = relief;
  const std::array<Lines, 2> directions = {Lines{stairs, false, whole_turn},
                                           Lines{stairs, true, whole_turn}};
  for (int y = 0; y < stairs.height; ++y)
    for (int x = 0; x < stairs.width; ++x)
      if (IsBesideAStep(stairs, x, y, whole_turn)) relief.at(x, y) = Smoothed(directions, x, y);
}

}  // namespace arthro::app

#include "authoring/footage/choose_frames.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "authoring/footage/frame_look.h"

namespace arthro::authoring {
namespace {

constexpr double kLeastStep = 1e-3;  // share of the window's width; counts a scope at rest a little
constexpr double kUnknownStep =
    0.1;  // share of the window's width, assumed when the motion is unknown

}  // namespace

std::vector<std::string> ReasonsAgainst(const std::vector<FrameLook>& looks,
                                        const ChooseOptions& options) {
  std::vector<std::string> reasons(looks.size());
  std::vector<std::size_t> left;
  for (std::size_t i = 0; i < looks.size(); ++i) {
    if (i % static_cast<std::size_t>(options.every) != 0)
      reasons[i] = fmt::format("one frame in {} is used", options.every);
    else if (options.skip_blank && !looks[i].blank.empty())
      reasons[i] = "blank: " + looks[i].blank;
    else
      left.push_back(i);
  }
  const auto most = static_cast<std::size_t>(options.most_frames);
  if (left.size() <= most) return reasons;

  // Position of each frame along the accumulated motion. The motion is cut into as many equal
  // stretches as frames are wanted.
  std::vector<double> way(left.size(), 0.0);
  for (std::size_t k = 1; k < left.size(); ++k) {
    const double moved = looks[left[k]].moved;
    way[k] = way[k - 1] + (moved < 0 ? kUnknownStep : std::max(moved, kLeastStep));
  }
  const double stretch = way.back() / static_cast<double>(most);
  // The last frame ends the last stretch and begins none.
  const auto number_of = [&](std::size_t k) {
    return std::min(std::floor(way[k] / stretch), static_cast<double>(most - 1));
  };
  for (std::size_t first = 0; first < left.size();) {
    const double number = number_of(first);
    std::size_t last = first, best = first;
    while (last < left.size() && number_of(last) == number) {
      if (looks[left[last]].sharpness > looks[left[best]].sharpness) best = last;
      ++last;
    }
    for (std::size_t k = first; k < last; ++k)
      if (k != best)
        reasons[left[k]] =
            fmt::format("frame {} shows the same stretch and is sharper", left[best]);
    first = last;
  }
  return reasons;
}

}  // namespace arthro::authoring

#include "authoring/depth/depth_preview.h"

#include <algorithm>
#include <array>
#include <utility>

#include "authoring/depth/grey_plane.h"

namespace arthro::authoring {
namespace {

constexpr int kLeastPixels = 1 << 14;  // halving a smaller picture gains nothing
constexpr int kGlint = 250;

// Mean of a block of pixels, rounded. Saturated pixels count only when there are no others, and
// black ones only when they are the majority, so that highlights and surround keep their edges.
std::array<std::uint8_t, 3> MeanOfBlock(const ColourImage& fine, int x0, int y0) {
  std::array<int, 3> tissue{}, glint{};
  int tissues = 0, glints = 0, blacks = 0;
  for (int y = y0; y < std::min(fine.height, y0 + 2); ++y)
    for (int x = x0; x < std::min(fine.width, x0 + 2); ++x) {
      const std::uint8_t* p = fine.at(x, y);
      const bool is_glint = std::min({p[0], p[1], p[2]}) >= kGlint;
      if (std::max({p[0], p[1], p[2]}) == 0) {
        ++blacks;
        continue;
      }
      for (int c = 0; c < 3; ++c) (is_glint ? glint : tissue)[c] += p[c];
      ++(is_glint ? glints : tissues);
    }
  if (blacks > tissues + glints) return {0, 0, 0};
  const auto& sum = tissues > 0 ? tissue : glint;
  const int count = std::max(1, tissues > 0 ? tissues : glints);
  std::array<std::uint8_t, 3> mean;
  for (int c = 0; c < 3; ++c) mean[c] = static_cast<std::uint8_t>((sum[c] + count / 2) / count);
  return mean;
}

ColourImage Halve(const ColourImage& fine) {
  ColourImage half((fine.width + 1) / 2, (fine.height + 1) / 2);
  ForStripsOfRows(half.height, [&](int first, int last) {
    for (int y = first; y < last; ++y)
      for (int x = 0; x < half.width; ++x) {
        const auto mean = MeanOfBlock(fine, 2 * x, 2 * y);
        std::copy(mean.begin(), mean.end(), half.at(x, y));
      }
  });
  return half;
}

std::int64_t Pixels(const ColourImage& image) { return std::int64_t{image.width} * image.height; }

}  // namespace

DepthPreview::DepthPreview(const ColourImage& panorama) {
  // Keeps the panorama itself only when it is small, since its owner has it already.
  Level level{panorama, 1};
  while (Pixels(level.picture) > kMostPixels) level = {Halve(level.picture), level.factor * 2};
  levels_.push_back(level);
  while (Pixels(level.picture) > kLeastPixels) {
    level = {Halve(level.picture), level.factor * 2};
    levels_.push_back(level);
  }
}

const DepthPreview::Level& DepthPreview::LevelOf(int most_pixels) const {
  const auto fits = [&](const Level& level) { return Pixels(level.picture) <= most_pixels; };
  const auto found = std::find_if(levels_.begin(), levels_.end(), fits);
  return found == levels_.end() ? levels_.back() : *found;
}

DepthMap DepthPreview::Filter(const DepthOptions& options, DepthReport* report, int most_pixels,
                              std::span<const DepthMark> marks) const {
  CheckDepthOptions(options);
  const Level& level = LevelOf(most_pixels);
  DepthOptions scaled = options;
  scaled.median_radius = (options.median_radius + level.factor / 2) / level.factor;
  scaled.border_margin = (options.border_margin + level.factor - 1) / level.factor;
  return DepthFromColour(level.picture, scaled, report, {}, marks);
}

int DepthPreview::Factor(int most_pixels) const { return LevelOf(most_pixels).factor; }

const ColourImage& DepthPreview::Picture(int most_pixels) const {
  return LevelOf(most_pixels).picture;
}

}  // namespace arthro::authoring

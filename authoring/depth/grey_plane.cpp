#include "authoring/depth/grey_plane.h"

#include <algorithm>
#include <cmath>

#include <opencv2/core.hpp>

namespace arthro::authoring {
namespace {

constexpr int kStripRows = 64;
constexpr int kSaturation =
    250;  // grey level, a little below 255, because JPEG rings around saturated areas

}  // namespace

void ForStripsOfRows(int height, const std::function<void(int, int)>& rows) {
  const int strips = (height + kStripRows - 1) / kStripRows;
  cv::parallel_for_(cv::Range(0, strips), [&](const cv::Range& range) {
    for (int strip = range.start; strip < range.end; ++strip)
      rows(strip * kStripRows, std::min(height, (strip + 1) * kStripRows));
  });
}

GreyPlane GreyFromColour(const ColourImage& panorama, const DepthOptions& options,
                         std::vector<std::uint8_t>& flags) {
  GreyPlane plane{panorama.width, panorama.height, {}, {}};
  const std::size_t count = static_cast<std::size_t>(plane.width) * plane.height;
  plane.grey.resize(count);
  plane.imaged.resize(count);
  flags.resize(count);
  // Integer weights that sum to 2^16, so that white stays white and every machine agrees.
  // Estimators by a light find only highlights in the grey; they use the default weights for it.
  const DepthOptions weights =
      options.estimator == DepthEstimator::kPaper ? options : DepthOptions();
  const double sum = weights.red_weight + weights.green_weight + weights.blue_weight;
  const auto red = static_cast<std::uint32_t>(std::lround(65536.0 * weights.red_weight / sum));
  const auto blue = static_cast<std::uint32_t>(std::lround(65536.0 * weights.blue_weight / sum));
  const std::uint32_t green = 65536u - std::min(65536u, red + blue);
  const int threshold = options.surround_threshold;
  ForStripsOfRows(plane.height, [&](int first, int last) {
    for (int y = first; y < last; ++y) {
      const std::uint8_t* from = panorama.at(0, y);
      std::uint16_t* grey = &plane.grey[plane.Index(0, y)];
      std::uint8_t* flag = &flags[plane.Index(0, y)];
      for (int x = 0; x < plane.width; ++x, from += 3) {
        const int r = from[0], g = from[1], b = from[2];
        const std::uint32_t weighted = (red * r + green * g + blue * b + 128) >> 8;
        grey[x] = static_cast<std::uint16_t>(std::min<std::uint32_t>(weighted, kWhite));
        const int most = std::max(r, std::max(g, b)), least = std::min(r, std::min(g, b));
        flag[x] = static_cast<std::uint8_t>(
            (most < threshold ? kDark : 0) | (most == 0 ? kBlack : 0) |
            (least >= kSaturation ? kSaturated : 0) | (2 * least >= most ? kPale : 0));
      }
    }
  });
  return plane;
}

}  // namespace arthro::authoring

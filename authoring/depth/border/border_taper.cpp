#include "authoring/depth/border/border_taper.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace arthro::authoring {

void TaperToBorder(DepthMap& depth, const std::vector<std::uint8_t>& imaged, double band) {
  if (!(band >= 1.0) || depth.empty()) return;
  const int width = depth.width, height = depth.height;
  // One pixel more on each side, so that the picture's edge is a border too.
  cv::Mat mask(height + 2, width + 2, CV_8U, cv::Scalar(0));
  cv::Mat sum(height, width, CV_32F), count(height, width, CV_32F);
  const auto index = [&](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  };
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const bool is_imaged = imaged[index(x, y)] != 0;
      mask.at<std::uint8_t>(y + 1, x + 1) = is_imaged ? 1 : 0;
      sum.at<float>(y, x) = is_imaged ? depth.at(x, y) : 0.0f;
      count.at<float>(y, x) = is_imaged ? 1.0f : 0.0f;
    }
  cv::Mat distance;
  cv::distanceTransform(mask, distance, cv::DIST_L2, cv::DIST_MASK_5);
  const int side = 4 * static_cast<int>(std::lround(band)) + 1;
  for (cv::Mat* values : {&sum, &count})
    cv::blur(*values, *values, {side, side}, {-1, -1}, cv::BORDER_CONSTANT);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double away = static_cast<double>(distance.at<float>(y + 1, x + 1));
      if (imaged[index(x, y)] == 0 || away > band) continue;
      const double t = (away - 1.0) / band;  // 0 at the last imaged pixel
      const double own = t * t * (3.0 - 2.0 * t);
      const double mean =
          static_cast<double>(sum.at<float>(y, x)) / static_cast<double>(count.at<float>(y, x));
      depth.at(x, y) =
          static_cast<float>(mean + own * (static_cast<double>(depth.at(x, y)) - mean));
    }
}

}  // namespace arthro::authoring

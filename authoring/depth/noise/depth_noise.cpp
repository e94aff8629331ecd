#include "authoring/depth/noise/depth_noise.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <opencv2/core.hpp>

#include "authoring/depth/noise/guided_smoothing.h"

namespace arthro::authoring {
namespace {

constexpr float kPerMedian = 1.4826f;  // standard deviation over the median distance, if normal
constexpr float kMostRatio = 2.0f;     // window's noise to that of the map, or back
constexpr int kFewest = 64;            // pixels for a median of their own

float Median(std::vector<float>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Distances of the known pixels of a part of the map; negative where there is none.
void Gather(const cv::Mat& off, const cv::Rect& part, std::vector<float>& values) {
  for (int y = part.y; y < part.y + part.height; ++y)
    for (int x = part.x; x < part.x + part.width; ++x)
      if (off.at<float>(y, x) >= 0) values.push_back(off.at<float>(y, x));
}

}  // namespace

DepthMap NoiseOfDepth(const DepthMap& depth, int texture_size) {
  if (texture_size <= 0 || depth.empty()) return {};
  const cv::Size size(depth.width, depth.height);
  cv::Mat relief(size, CV_32F), weight(size, CV_32F);
  for (std::size_t i = 0; i < depth.relief.size(); ++i) {
    const bool is_known = std::isfinite(depth.relief[i]);
    relief.ptr<float>()[i] = is_known ? depth.relief[i] : 0.0f;
    weight.ptr<float>()[i] = is_known ? 1.0f : 0.0f;
  }
  // Three means over 2 n + 1 pixels have a standard deviation of n pixels, nearly.
  cv::Mat mean = relief;
  for (int pass = 0; pass < 3; ++pass) mean = WeightedMean(mean, weight, texture_size);
  cv::Mat off = cv::abs(relief - mean);
  off.setTo(-1.0f, weight == 0);
  std::vector<float> values;
  Gather(off, {{}, size}, values);
  if (values.empty()) return {};
  const float usual = Median(values);
  if (!(usual > 0.0f)) return {};

  // Medians of windows of 3 x 3 blocks, in the middle of each block.
  const int block = 2 * texture_size;
  const int columns = (depth.width + block - 1) / block, rows = (depth.height + block - 1) / block;
  cv::Mat noise(rows, columns, CV_32F);
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      values.clear();
      Gather(off,
             cv::Rect((i - 1) * block, (j - 1) * block, 3 * block, 3 * block) & cv::Rect({}, size),
             values);
      const float own = values.size() < kFewest ? usual : Median(values);
      noise.at<float>(j, i) = kPerMedian * std::clamp(own, usual / kMostRatio, usual * kMostRatio);
    }
  DepthMap sigma = depth;
  for (int y = 0; y < depth.height; ++y)
    for (int x = 0; x < depth.width; ++x) {
      if (!std::isfinite(depth.at(x, y))) continue;
      const float u = std::clamp((static_cast<float>(x) + 0.5f) / static_cast<float>(block) - 0.5f,
                                 0.0f, static_cast<float>(columns - 1)),
                  v = std::clamp((static_cast<float>(y) + 0.5f) / static_cast<float>(block) - 0.5f,
                                 0.0f, static_cast<float>(rows - 1));
      const int i = static_cast<int>(u), j = static_cast<int>(v);
      const int right = std::min(i + 1, columns - 1), below = std::min(j + 1, rows - 1);
      const float f = u - static_cast<float>(i), g = v - static_cast<float>(j);
      sigma.at(x, y) =
          (1 - g) * ((1 - f) * noise.at<float>(j, i) + f * noise.at<float>(j, right)) +
          g * ((1 - f) * noise.at<float>(below, i) + f * noise.at<float>(below, right));
    }
  return sigma;
}

}  // namespace arthro::authoring

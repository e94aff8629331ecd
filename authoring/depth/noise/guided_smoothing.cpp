#include "authoring/depth/noise/guided_smoothing.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace arthro::authoring {
namespace {

template <class Smooth>
cv::Mat Weighted(const cv::Mat& values, const cv::Mat& weight, const Smooth& smooth) {
  cv::Mat sum, total;
  smooth(values.mul(weight), sum);
  smooth(weight, total);
  constexpr double kNothing = 1e-6;  // residue of running sums that should be zero
  total.setTo(1.0, total < kNothing);
  cv::divide(sum, total, sum);
  return sum;
}

}  // namespace

cv::Mat WeightedMean(const cv::Mat& values, const cv::Mat& weight, int radius) {
  return Weighted(values, weight, [&](const cv::Mat& from, cv::Mat& to) {
    cv::boxFilter(from, to, CV_32F, {2 * radius + 1, 2 * radius + 1}, {-1, -1}, true,
                  cv::BORDER_CONSTANT);
  });
}

cv::Mat WeightedBlur(const cv::Mat& values, const cv::Mat& weight, double sigma) {
  return Weighted(values, weight, [&](const cv::Mat& from, cv::Mat& to) {
    cv::GaussianBlur(from, to, {}, sigma, sigma, cv::BORDER_CONSTANT);
  });
}

cv::Mat GuidedSmoothing(const cv::Mat& values, const cv::Mat& weight, int radius, double edge,
                        double noise) {
  if (radius <= 0) return values;
  const cv::Mat mean = WeightedMean(values, weight, radius);
  const cv::Mat variance = WeightedMean(values.mul(values), weight, radius) - mean.mul(mean);
  const cv::Mat signal = cv::max(variance - noise * noise, 0);
  cv::Mat slope, offset;
  cv::divide(signal, signal + mean.mul(mean) * (edge * edge) + noise * noise + 1e-12, slope);
  offset = mean - slope.mul(mean);
  return WeightedMean(slope, weight, radius).mul(values) + WeightedMean(offset, weight, radius);
}

double NoiseOf(const cv::Mat& values, const cv::Mat& weight) {
  constexpr int kStride = 3;  // rows; enough samples remain
  std::vector<float> differences;
  for (int y = 0; y < values.rows; y += kStride) {
    const float *v = values.ptr<float>(y), *w = weight.ptr<float>(y);
    for (int x = 1; x + 1 < values.cols; ++x)
      if (w[x - 1] > 0 && w[x] > 0 && w[x + 1] > 0)
        differences.push_back(std::abs(v[x - 1] - 2 * v[x] + v[x + 1]));
  }
  if (differences.empty()) return 0;
  const auto middle = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 2);
  std::nth_element(differences.begin(), middle, differences.end());
  return *middle / (0.6745 * std::sqrt(6.0));  // median of |normal|; 1 + 4 + 1 variances
}

}  // namespace arthro::authoring

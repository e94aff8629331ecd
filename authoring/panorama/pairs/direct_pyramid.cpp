#include "authoring/panorama/pairs/direct_pyramid.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "simulation/core/error.h"

namespace arthro::authoring {
namespace {

constexpr float kMostDeviations = 3.0f;
// Own px of a level: against pixel noise, before differences are taken.
constexpr double kFinestSmoothing = 1.0, kCoarserSmoothing = 0.7;
// A pixel of a level counts when this share of what was averaged into it was valid.
constexpr float kLeastWeight = 0.6f;
// Nearer to the rim the ground that is taken off is known from one side only, and the band leans.
constexpr float kLeastGround = 0.8f;
// Below this deviation, in grey levels, a band holds rounding and nothing else.
constexpr float kLeastDeviation = 0.05f;

// Value times weight, and weight.
cv::Mat Weighted(const WorkingFrame& frame) {
  cv::Mat weighted(frame.grey.size(), CV_32FC2);
  for (int y = 0; y < weighted.rows; ++y) {
    const std::uint8_t* grey = frame.grey.ptr<std::uint8_t>(y);
    const std::uint8_t* mask = frame.mask.ptr<std::uint8_t>(y);
    float* out = weighted.ptr<float>(y);
    for (int x = 0; x < weighted.cols; ++x) {
      const float m = mask[x] ? 1.0f : 0.0f;
      out[2 * x] = m * (static_cast<float>(grey[x]) - 128.0f);
      out[2 * x + 1] = m;
    }
  }
  return weighted;
}

// Robust deviation of the band values, from their median magnitude.
float DeviationOf(const cv::Mat& band) {
  std::vector<float> magnitudes;
  const int step = std::max(1, static_cast<int>(band.total() / 16000));
  for (int i = 0; i < static_cast<int>(band.total()); i += step) {
    const float v = band.ptr<float>()[i];
    if (v < 1e8f) magnitudes.push_back(std::abs(v));
  }
  if (magnitudes.size() < 16) return 0.0f;
  const auto middle = magnitudes.begin() + static_cast<std::ptrdiff_t>(magnitudes.size() / 2);
  std::nth_element(magnitudes.begin(), middle, magnitudes.end());
  return 1.4826f * *middle;
}

// Difference of the smoothed level and the one two octaves up; 1e9 where it is not valid.
cv::Mat Difference(const cv::Mat& own, const cv::Mat& smooth, const cv::Mat& coarse) {
  cv::Mat band(own.size(), CV_32FC1);
  for (int y = 0; y < own.rows; ++y) {
    const float *o = own.ptr<float>(y), *s = smooth.ptr<float>(y), *c = coarse.ptr<float>(y);
    float* out = band.ptr<float>(y);
    for (int x = 0; x < own.cols; ++x) {
      const bool valid = o[2 * x + 1] > kLeastWeight && c[2 * x + 1] > kLeastGround;
      out[x] = valid ? s[2 * x] / s[2 * x + 1] - c[2 * x] / c[2 * x + 1] : 1e9f;
    }
  }
  return band;
}

// In each small cell the pixels with the strongest gradients, so that all of the frame speaks.
std::vector<std::int32_t> StrongPoints(const cv::Mat& band, int valid, int most) {
  constexpr int kCell = 8;
  const double share = std::min(1.0, static_cast<double>(most) / std::max(1, valid));
  std::vector<std::int32_t> points;
  std::vector<std::pair<int, std::int32_t>> cell;
  for (int y0 = 1; y0 < band.rows - 1; y0 += kCell)
    for (int x0 = 1; x0 < band.cols - 1; x0 += kCell) {
      cell.clear();
      for (int y = y0; y < std::min(y0 + kCell, band.rows - 1); ++y) {
        const std::int8_t* row = band.ptr<std::int8_t>(y);
        const std::int8_t *up = band.ptr<std::int8_t>(y - 1), *down = band.ptr<std::int8_t>(y + 1);
        for (int x = x0; x < std::min(x0 + kCell, band.cols - 1); ++x) {
          if (row[x] == kNoBand || row[x - 1] == kNoBand || row[x + 1] == kNoBand ||
              up[x] == kNoBand || down[x] == kNoBand)
            continue;
          const int gx = row[x + 1] - row[x - 1], gy = down[x] - up[x];
          cell.emplace_back(gx * gx + gy * gy, y * band.cols + x);
        }
      }
      const std::size_t keep =
          static_cast<std::size_t>(std::lround(share * static_cast<double>(cell.size())));
      if (keep < cell.size())
        std::nth_element(cell.begin(), cell.begin() + static_cast<std::ptrdiff_t>(keep), cell.end(),
                         [](const auto& a, const auto& b) {
                           return a.first != b.first ? a.first > b.first : a.second < b.second;
                         });
      for (std::size_t i = 0; i < keep; ++i) points.push_back(cell[i].second);
    }
  std::sort(points.begin(), points.end());
  return points;
}

}  // namespace

cv::Size SpectrumSize(cv::Size level) {
  // Shifts of more than half the canvas come back from the other side; CoarseAlign tries both.
  return {cv::getOptimalDFTSize(level.width + 8), cv::getOptimalDFTSize(level.height + 8)};
}

cv::Mat ApodisedBand(const cv::Mat& band, cv::Size canvas) {
  cv::Mat soft(band.size(), CV_32FC1);
  for (int y = 0; y < band.rows; ++y)
    for (int x = 0; x < band.cols; ++x)
      soft.at<float>(y, x) = band.at<std::int8_t>(y, x) != kNoBand ? 1.0f : 0.0f;
  cv::blur(soft, soft, {7, 7}, {-1, -1}, cv::BORDER_CONSTANT);
  cv::Mat out = cv::Mat::zeros(canvas, CV_32FC1);
  for (int y = 0; y < band.rows; ++y)
    for (int x = 0; x < band.cols; ++x) {
      const int v = band.at<std::int8_t>(y, x);
      const float s = 2.0f * soft.at<float>(y, x) - 1.0f;
      if (v != kNoBand && s > 0) out.at<float>(y, x) = s * static_cast<float>(v) / kBandUnit;
    }
  return out;
}

DirectPyramid::DirectPyramid(const WorkingFrame& frame, const DirectOptions& options)
    : index_(frame.index) {
  if (frame.grey.type() != CV_8UC1 || frame.mask.type() != CV_8UC1 ||
      frame.grey.size() != frame.mask.size() || !(frame.scale > 0))
    throw Error(Code::kBadImage,
                "a working frame needs an 8-bit grey picture and a mask of the same size");
  if (frame.grey.empty()) throw Error(Code::kBadImage, "a working frame is empty");
  cv::Mat octaves[kDirectLevels + 2];
  octaves[0] = Weighted(frame);
  for (int k = 1; k < kDirectLevels + 2; ++k) cv::pyrDown(octaves[k - 1], octaves[k]);

  const double s = frame.scale;
  for (int k = 0; k < kDirectLevels; ++k) {
    DirectLevel& level = levels_[k];
    const double f = 1.0 / (1 << k);
    level.level_from_rectified = {s * f, 0, (0.5 * s - 0.5) * f, 0, s * f, (0.5 * s - 0.5) * f, 0,
                                  0,     1};
    cv::Mat smooth, coarse;
    const double sigma = k == 0 ? kFinestSmoothing : kCoarserSmoothing;
    cv::GaussianBlur(octaves[k], smooth, {0, 0}, sigma);
    cv::pyrUp(octaves[k + 2], coarse, octaves[k + 1].size());
    cv::pyrUp(coarse, coarse, octaves[k].size());
    const cv::Mat band = Difference(octaves[k], smooth, coarse);
    const float deviation = DeviationOf(band);
    level.band = cv::Mat(band.size(), CV_8SC1, cv::Scalar(kNoBand));
    if (!(deviation > kLeastDeviation)) continue;
    for (int y = 0; y < band.rows; ++y) {
      const float* v = band.ptr<float>(y);
      std::int8_t* out = level.band.ptr<std::int8_t>(y);
      for (int x = 0; x < band.cols; ++x) {
        if (v[x] > 1e8f) continue;
        const float cut = std::clamp(v[x] / deviation, -kMostDeviations, kMostDeviations);
        out[x] = static_cast<std::int8_t>(std::lrint(kBandUnit * cut));
        ++level.valid;
      }
    }
    level.points = StrongPoints(level.band, level.valid, options.most_points);
  }
  const DirectLevel& last = levels_[kDirectLevels - 1];
  if (last.points.size() < 64) return;
  cv::dft(ApodisedBand(last.band, SpectrumSize(last.band.size())), spectrum_, 0, last.band.rows);
}

}  // namespace arthro::authoring

#include "authoring/panorama/pairs/direct_pyramid.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "simulation/core/error.h"

namespace arthro::authoring {
namespace {

constexpr float kMostDeviations = 3.0f;
// px of the level: smoothing against pixel noise, before differences are taken.
constexpr double kFinestSmoothing = 1.0, kCoarserSmoothing = 0.7;
// Share of valid pixels among those averaged into a pixel of a level; below it the pixel does not
// count.
constexpr float kLeastWeight = 0.6f;
// Least weight of the subtracted background: nearer to the rim it is known from one side only, and
// the band is biased.
constexpr float kLeastGround = 0.8f;
// Deviation in grey levels below which a band holds only rounding errors.
constexpr float kLeastDeviation = 0.05f;

constexpr float kInvalid = 1e9f;
// Shares of the option most_points, for one band of each level: coarse levels have fewer waves to
// place.
constexpr double kShareOfPoints[kDirectLevels] = {0.4, 0.4, 0.25};
constexpr std::size_t kFewestCoarse = 64;  // on the coarsest level

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
  const int step = std::max(1, static_cast<int>(band.total() / 8000));
  for (int i = 0; i < static_cast<int>(band.total()); i += step) {
    const float v = band.ptr<float>()[i];
    if (v < kInvalid) magnitudes.push_back(std::abs(v));
  }
  if (magnitudes.size() < 16) return 0.0f;
  const auto middle = magnitudes.begin() + static_cast<std::ptrdiff_t>(magnitudes.size() / 2);
  std::nth_element(magnitudes.begin(), middle, magnitudes.end());
  return 1.4826f * *middle;
}

// Difference of the smoothed level and the one two octaves up; kInvalid for invalid pixels.
cv::Mat Difference(const cv::Mat& own, const cv::Mat& smooth, const cv::Mat& coarse) {
  cv::Mat band(own.size(), CV_32FC1);
  for (int y = 0; y < own.rows; ++y) {
    const float *o = own.ptr<float>(y), *s = smooth.ptr<float>(y), *c = coarse.ptr<float>(y);
    float* out = band.ptr<float>(y);
    for (int x = 0; x < own.cols; ++x) {
      const float ws = std::max(s[2 * x + 1], 1e-3f), wc = std::max(c[2 * x + 1], 1e-3f);
      const float difference = (s[2 * x] * wc - c[2 * x] * ws) / (ws * wc);
      const bool valid = o[2 * x + 1] > kLeastWeight && c[2 * x + 1] > kLeastGround;
      out[x] = valid ? difference : kInvalid;
    }
  }
  return band;
}

// Quantises in units of the deviation, clipped, to a byte per pixel. Returns the number of valid
// pixels.
int Quantise(const cv::Mat& band, float deviation, cv::Mat& bytes) {
  bytes.create(band.size(), CV_8SC1);
  const float scale = kBandUnit / deviation, most = kBandUnit * kMostDeviations;
  int valid = 0;
  for (int y = 0; y < band.rows; ++y) {
    const float* v = band.ptr<float>(y);
    std::int8_t* out = bytes.ptr<std::int8_t>(y);
    for (int x = 0; x < band.cols; ++x) {
      const float cut = std::min(std::max(v[x] * scale, -most), most);
      const int rounded = static_cast<int>(cut + 256.5f) - 256;
      const bool is_valid = v[x] < kInvalid;
      out[x] = static_cast<std::int8_t>(is_valid ? rounded : kNoBand);
      valid += is_valid;
    }
  }
  return valid;
}

// Selects one pixel per block, the one with the strongest gradient, so that all of the frame
// contributes. Blocks are as large as needed to keep `most` of the valid pixels.
std::vector<std::int32_t> StrongPoints(const cv::Mat& band, int valid, int most) {
  int wide = 1, high = 1;
  while (wide * high * most < valid) (wide > high ? high : wide) += 1;
  std::vector<std::int32_t> points;
  points.reserve(static_cast<std::size_t>(valid / (wide * high)) + 1);
  const std::ptrdiff_t stride = static_cast<std::ptrdiff_t>(band.step1());
  for (int y0 = 1; y0 + high < band.rows; y0 += high)
    for (int x0 = 1; x0 + wide < band.cols; x0 += wide) {
      int strongest = -1, at = 0;
      for (int y = y0; y < y0 + high; ++y) {
        const std::int8_t* row = band.ptr<std::int8_t>(y);
        for (int x = x0; x < x0 + wide; ++x) {
          const std::int8_t* p = row + x;
          if (p[0] == kNoBand || p[-1] == kNoBand || p[1] == kNoBand || p[-stride] == kNoBand ||
              p[stride] == kNoBand)
            continue;
          const int gx = p[1] - p[-1], gy = p[stride] - p[-stride], strength = gx * gx + gy * gy;
          if (strength > strongest) strongest = strength, at = y * band.cols + x;
        }
      }
      if (strongest >= 0) points.push_back(at);
    }
  return points;
}

// Difference of the band over kReach pixels in both directions along the radius from the middle.
cv::Mat RadialDifference(const cv::Mat& band) {
  constexpr int kReach = 1;  // px: a quarter of the shortest wave
  cv::Mat out(band.size(), CV_32FC1, cv::Scalar(kInvalid));
  const float cx = 0.5f * static_cast<float>(band.cols - 1),
              cy = 0.5f * static_cast<float>(band.rows - 1);
  for (int y = kReach; y < band.rows - kReach; ++y) {
    const float *row = band.ptr<float>(y), *up = band.ptr<float>(y - kReach),
                *down = band.ptr<float>(y + kReach);
    float* to = out.ptr<float>(y);
    const float ey = static_cast<float>(y) - cy;
    for (int x = kReach; x < band.cols - kReach; ++x) {
      const float left = row[x - kReach], right = row[x + kReach], ex = static_cast<float>(x) - cx;
      const float along =
          (ex * (right - left) + ey * (down[x] - up[x])) / std::sqrt(ex * ex + ey * ey + 1.0f);
      const float largest = std::max(std::max(left, right), std::max(up[x], down[x]));
      to[x] = std::max(largest, row[x]) < kInvalid ? along : kInvalid;
    }
  }
  return out;
}

DirectBand Compact(const cv::Mat& band, int most_points) {
  DirectBand compact;
  const float deviation = DeviationOf(band);
  if (!(deviation > kLeastDeviation)) {
    compact.values = cv::Mat(band.size(), CV_8SC1, cv::Scalar(kNoBand));
    return compact;
  }
  const int valid = Quantise(band, deviation, compact.values);
  compact.points = StrongPoints(compact.values, valid, most_points);
  return compact;
}

}  // namespace

cv::Size SpectrumSize(cv::Size level) {
  // Shifts of more than half the canvas wrap around; CoarseAlign tries both.
  return {cv::getOptimalDFTSize(level.width + 8), cv::getOptimalDFTSize(level.height + 8)};
}

cv::Mat ApodisedBand(const DirectBand& source, cv::Size canvas) {
  const cv::Mat& band = source.values;
  cv::Mat soft(band.size(), CV_32FC1);
  for (int y = 0; y < band.rows; ++y)
    for (int x = 0; x < band.cols; ++x)
      soft.at<float>(y, x) = band.at<std::int8_t>(y, x) != kNoBand ? 1.0f : 0.0f;
  cv::blur(soft, soft, {7, 7}, {-1, -1}, cv::BORDER_CONSTANT);
  cv::Mat out = cv::Mat::zeros(canvas, CV_32FC1);
  for (int y = 0; y < band.rows; ++y)
    for (int x = 0; x < band.cols; ++x) {
      // NOLINTNEXTLINE(bugprone-signed-char-misuse): a number of eight bits, no character
      const auto v = static_cast<int>(band.at<std::int8_t>(y, x));
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
    const int most = static_cast<int>(kShareOfPoints[k] * options.most_points);
    level.bands[kColour] = Compact(band, most);
    level.bands[kRelief] = Compact(RadialDifference(band), most);
  }
  const DirectLevel& last = levels_[kDirectLevels - 1];
  if (last.bands[kColour].points.size() < kFewestCoarse ||
      last.bands[kRelief].points.size() < kFewestCoarse)
    return;
  for (const Texture texture : {kColour, kRelief})
    cv::dft(ApodisedBand(last.bands[texture], SpectrumSize(last.size())), spectra_[texture], 0,
            last.size().height);
}

}  // namespace arthro::authoring

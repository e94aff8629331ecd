// Evens out the light of a frame. A frontal light falls off smoothly and its camera encodes it by a
// power law. In the logarithm, light and exposure are therefore a smooth sum and gamma is a factor,
// which a local mean and a local gain remove [paper, 3.1]. Pictures are working ones
// (working_frame.h); masks are CV_8UC1, 255 at pixels that count.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>

namespace arthro::authoring {

// Weights of the colours in the grey that is matched; their sum need not be one.
struct ColourMix {
  double red = 0.15, green = 0.6, blue = 0.25;
};

// CV_32FC1, 0 to 255.
cv::Mat MixColours(const cv::Mat& rgb, const ColourMix& mix);

// Natural logarithm of a mixed grey, with values below 1 raised to 1.
cv::Mat LogOf(const cv::Mat& mixed);

// Subtracts from `value` (CV_32FC1) the quadratic that best fits its unmasked pixels. It holds most
// of the falloff, whose curvature would otherwise bias a local mean.
void RemoveQuadratic(cv::Mat& value, const cv::Mat& mask);

// Smooth part of a value: at each pixel the plane that best fits the unmasked surroundings,
// weighted by a Gaussian of `sigma` px, evaluated at the pixel. At the rim the surroundings lie on
// one side only, and a mean instead of a plane would show the falloff as a halo. The result is 0
// without unmasked pixels in reach. The computation that depends on the mask alone is done once for
// all values.
class MaskedSurround {
 public:
  // `mask` CV_8UC1, kept and not copied.
  MaskedSurround(const cv::Mat& mask, double sigma);
  cv::Mat Of(const cv::Mat& value) const;  // CV_32FC1 of the mask's size, and so is the result

 private:
  cv::Mat mask_;
  int cell_, columns_ = 0, rows_ = 0;         // px; large surroundings use larger cells
  std::vector<float> kernel_;                 // from its middle outwards
  std::vector<std::array<float, 3>> planes_;  // weights of a cell's moments in its plane's value
};

// Sensor noise by brightness: standard deviation of the mixed grey, grey levels.
class NoiseCurve {
 public:
  static constexpr int kBins = 16;  // 16 grey levels each

  // Adds the samples of one mixed picture; pixels of even coordinates are enough.
  void Add(const cv::Mat& mixed, const cv::Mat& mask);
  bool IsEmpty() const { return pixels_ == 0; }
  // Estimates the noise from the quieter half of the pixels, so that texture does not count. At
  // least 0.2, the rounding of an 8-bit picture.
  void Finish();
  double At(double grey) const;

 private:
  static constexpr int kLevels =
      256;  // levels of the filter's response, a quarter of a grey level each
  std::int64_t pixels_ = 0;
  cv::Mat_<int> counts_;
  std::array<double, kBins> sigma_{};
};

}  // namespace arthro::authoring

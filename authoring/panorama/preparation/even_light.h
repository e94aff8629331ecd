// Takes the light out of a frame. A frontal light falls off smoothly and its camera encodes it by
// a power law, so in the logarithm light and exposure are a smooth sum and gamma is a factor: what
// a local mean and a local gain remove [paper, 3.1].
// Pictures are working ones (working_frame.h); masks are CV_8UC1, 255 where a pixel counts.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>

namespace arthro::authoring {

// How the colours make the one grey that is matched; they need not add up to one.
struct ColourMix {
  double red = 0.15, green = 0.6, blue = 0.25;
};

// CV_32FC1, 0 to 255.
cv::Mat MixColours(const cv::Mat& rgb, const ColourMix& mix);

// Natural logarithm of a mixed grey, which it takes for at least 1.
cv::Mat LogOf(const cv::Mat& mixed);

// Takes the quadratic that fits the unmasked pixels best away from `value` (CV_32FC1): most of what
// a falloff is, which would bend within the surround of a local mean.
void RemoveQuadratic(cv::Mat& value, const cv::Mat& mask);

// What of a value is smooth: at each pixel the plane that fits the unmasked surround best, weighed
// by a Gaussian of `sigma` px, read at the pixel. A plane and not a mean, because at the rim the
// surround lies on one side only and a mean would show the falloff as a halo. Where no unmasked
// pixel is in reach, 0. The mask's share of the work is done once for all values.
class MaskedSurround {
 public:
  // `mask` CV_8UC1, kept and not copied.
  MaskedSurround(const cv::Mat& mask, double sigma);
  cv::Mat Of(const cv::Mat& value) const;  // CV_32FC1 of the mask's size, and so is the result

 private:
  cv::Mat mask_;
  int cell_, columns_ = 0, rows_ = 0;         // px; wide surrounds take larger cells
  std::vector<float> kernel_;                 // from its middle outwards
  std::vector<std::array<float, 3>> planes_;  // weights of a cell's moments in its plane's value
};

// Sensor noise by brightness, standard deviation in grey levels of the mixed grey.
class NoiseCurve {
 public:
  static constexpr int kBins = 16;  // of 16 grey levels each

  // Learns from one mixed picture; pixels of even coordinates are enough.
  void Add(const cv::Mat& mixed, const cv::Mat& mask);
  bool IsEmpty() const { return pixels_ == 0; }
  // From the quieter half of the pixels, so that texture does not count. At least 0.2, the rounding
  // of an 8-bit picture.
  void Finish();
  double At(double grey) const;

 private:
  static constexpr int kLevels = 256;  // of the filter's answer, a quarter of a grey level each
  std::int64_t pixels_ = 0;
  cv::Mat_<int> counts_;
  std::array<double, kBins> sigma_{};
};

}  // namespace arthro::authoring

// What direct alignment looks at in a frame: its fine texture alone, at a half, a quarter and an
// eighth of the rectified scale (for working frames at scale 0.5). Each level keeps the wavelengths
// of about 4 to 16 of its own pixels, so that neither slow haze and light nor pixel noise counts,
// in units of its own robust deviation and cut off at kMostDeviations, so that debris and glints
// weigh no more than strong texture. Compact: a byte a pixel.
//
// A level's pixel k times halved: x_level = x_work / 2^k, with x_work = (x + 0.5) scale - 0.5.
#pragma once

#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>

#include "authoring/panorama/pairs/direct_options.h"
#include "authoring/panorama/working_frame.h"

namespace arthro::authoring {

inline constexpr int kDirectLevels = 3;
inline constexpr float kBandUnit = 32.0f;  // stored value of one deviation
inline constexpr int kNoBand = -128;       // stored value where there is nothing to compare

struct DirectLevel {
  cv::Matx33d level_from_rectified;
  cv::Mat band;                      // CV_8SC1
  std::vector<std::int32_t> points;  // indices of the pixels that are aligned, ascending
  int valid = 0;                     // pixels that have a band value
};

class DirectPyramid {
 public:
  explicit DirectPyramid(const WorkingFrame& frame, const DirectOptions& options = {});

  int index() const { return index_; }
  // 0 is the finest. Every level exists; a frame without texture or mask has levels without points.
  const DirectLevel& level(int k) const { return levels_[k]; }
  // Fourier transform of the coarsest level, as cv::dft packs it; empty for a frame without
  // texture.
  const cv::Mat& spectrum() const { return spectrum_; }
  bool HasTexture() const { return !spectrum_.empty(); }

 private:
  int index_ = 0;
  DirectLevel levels_[kDirectLevels];
  cv::Mat spectrum_;
};

// The band as float, times a soft mask that is 0 at the border of what is valid, on a canvas for
// cv::dft.
cv::Mat ApodisedBand(const cv::Mat& band, cv::Size canvas);
cv::Size SpectrumSize(cv::Size level);

}  // namespace arthro::authoring

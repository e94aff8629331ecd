// What all frames of a clip share because it is fixed to the camera and not to the tissue: the
// light's falloff and the vignette, text and logos, dirt on the lens, and the sensor's noise.
// Learned in one sequential pass in constant memory. All pictures are working ones
// (working_frame.h) of one size.
#pragma once

#include <opencv2/core.hpp>

#include "authoring/panorama/preparation/even_light.h"

namespace arthro::authoring {

struct ClipLook {
  int frames = 0;        // that were looked at
  cv::Mat light;         // CV_32FC1, natural logarithm, smooth, 0 on average; empty: not known
  cv::Mat static_marks;  // CV_8UC1, 255 where a mark is fixed to the picture; empty: none
  NoiseCurve noise;      // of the mixed grey; empty: each frame finds its own
};

class ClipLookBuilder {
 public:
  explicit ClipLookBuilder(const ColourMix& mix = {}) : mix_(mix) {}

  // `working_rgb` CV_8UC3, RGB; `mask` CV_8UC1, 255 where the lens shows something. Long clips are
  // thinned: of n frames some 32 log2(n/32) are used. Throws Error(kBadImage) when a frame's size
  // differs from the first one's.
  void Add(const cv::Mat& working_rgb, const cv::Mat& mask);
  ClipLook Finish();

 private:
  void FindStaticMarks(ClipLook& look) const;

  ColourMix mix_;
  int offered_ = 0, used_ = 0, stride_ = 1;
  cv::Mat window_;                   // CV_8U, where any frame's mask let something through
  cv::Mat seen_;                     // CV_32F, how often each pixel was neither masked nor glaring
  cv::Mat light_;                    // CV_32F, sum of the smooth logarithms, each less its mean
  cv::Mat detail_, detail_squared_;  // CV_32F, sums over the frames of what is not smooth
  NoiseCurve noise_;
};

}  // namespace arthro::authoring

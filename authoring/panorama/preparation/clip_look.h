// Properties that all frames of a clip share because they belong to the camera, not to the tissue:
// falloff and vignetting of the light, text and logos, dirt on the lens, and the sensor's noise.
// Estimated in one sequential pass in constant memory. All pictures are working ones
// (working_frame.h) of one size.
#pragma once

#include <opencv2/core.hpp>

#include "authoring/panorama/preparation/even_light.h"

namespace arthro::authoring {

struct ClipLook {
  int frames = 0;        // number of frames that were used
  cv::Mat light;         // CV_32FC1, natural logarithm, smooth, 0 on average; empty: unknown
  cv::Mat static_marks;  // CV_8UC1, 255 at marks fixed to the picture; empty: none
  cv::Mat static_cores;  // CV_8UC1, 255 at their strokes, without their halo; empty: none
  NoiseCurve noise;      // noise of the mixed grey; empty: each frame estimates its own
};

class ClipLookBuilder {
 public:
  explicit ClipLookBuilder(const ColourMix& mix = {}) : mix_(mix) {}

  // `working_rgb` CV_8UC3, RGB; `mask` CV_8UC1, 255 inside the lens's visible area. Long clips are
  // thinned: about 32 log2(n/32) of n frames are used. Throws Error(kBadImage) when a frame's size
  // differs from the first one's.
  void Add(const cv::Mat& working_rgb, const cv::Mat& mask);
  ClipLook Finish();

 private:
  void FindStaticMarks(ClipLook& look) const;

  ColourMix mix_;
  int offered_ = 0, used_ = 0, stride_ = 1;
  cv::Mat window_;  // CV_8U, union of the frames' masks
  cv::Mat seen_;    // CV_32F, number of frames in which a pixel was neither masked nor overexposed
  cv::Mat logs_;    // CV_32F, sum of the logarithms of all frames, glare included
  cv::Mat light_;   // CV_32F, sum of the smooth logarithms, each minus its mean
  cv::Mat detail_, detail_squared_;  // CV_32F, sums of the detail over the frames
  NoiseCurve noise_;
};

}  // namespace arthro::authoring

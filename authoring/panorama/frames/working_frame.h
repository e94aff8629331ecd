// One frame as the registration sees it: rectified, at the working scale, with even light. Used to
// match only; its greys never reach the panorama. Working pixels relate to rectified ones as
// x_work = (x + 0.5) scale - 0.5 (rectifier.h).
#pragma once

#include <opencv2/core.hpp>

namespace arthro::authoring {

struct WorkingFrame {
  int index = 0;       // in the footage
  double scale = 0.5;  // working pixels per rectified pixel
  cv::Mat grey;        // CV_8UC1, 128 on average, light and vignette taken out
  cv::Mat mask;        // CV_8UC1, 255 where tissue can be matched: no rim, highlight, tool, text
  double noise = 0;    // standard deviation of `grey` that is sensor noise, grey levels
  double texture = 0;  // standard deviation of `grey` that is not
};

}  // namespace arthro::authoring

// One frame for registration: rectified, at the working scale, with evened-out light. Used for
// matching only; its greys never reach the panorama. Working pixels relate to rectified ones as
// x_work = (x + 0.5) scale - 0.5 (rectifier.h).
#pragma once

#include <opencv2/core.hpp>

namespace arthro::authoring {

struct WorkingFrame {
  int index = 0;       // in the footage
  double scale = 0.5;  // working pixels per rectified pixel
  cv::Mat grey;        // CV_8UC1, 128 on average, without light and vignetting
  cv::Mat mask;        // CV_8UC1, 255 at tissue for matching: no rim, highlight, tool, text
  double noise = 0;    // standard deviation of the sensor noise in `grey`, grey levels
  double texture = 0;  // standard deviation of the remainder of `grey`
};

}  // namespace arthro::authoring

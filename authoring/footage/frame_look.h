// Measures a frame before its position is known: whether it is blank, how sharp it is, and how far
// the view moved since the frame before. Uses a thumbnail of the raw frame; about 2 ms for 800 x
// 640.
#pragma once

#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "simulation/scene/lens.h"

namespace arthro::authoring {

struct FrameLook {
  double brightness = 0;  // mean green inside the window, 0 to 255
  double redness = 1;     // mean red over mean green
  double spread = 0;      // light over the window: 5th to 95th percentile over the mean
  double detail = 0;      // standard deviation of fine detail without noise, over the mean
  double sharpness =
      0;  // strength of edges two to four raw pixels wide, over the mean; for comparison only
  double moved = 0;   // motion since the frame before, share of the window's width; -1: unknown
  std::string blank;  // reason for a frame without content; "" for a useful frame
};

// Measures the frames of one clip in their order.
class FrameLooker {
 public:
  // Radius 0: the window is the whole picture.
  explicit FrameLooker(const LensCircle& circle = {}) : circle_(circle) {}
  FrameLook Look(const cv::Mat& rgb);

 private:
  void MakeMask(cv::Size raw);

  LensCircle circle_;
  cv::Size raw_;
  cv::Mat mask_, weight_;     // CV_8UC1 and CV_32FC1, size of the thumbnail
  cv::Rect middle_;           // square inside the window, for the motion
  cv::Mat taper_, previous_;  // CV_32FC1, size of that square
};

// Marks frames that are blank compared with their clip though not by themselves: hardly any detail,
// and a brightness or a colour that no other frame has. Sets `blank`.
void MarkBlanks(std::vector<FrameLook>& looks);

}  // namespace arthro::authoring

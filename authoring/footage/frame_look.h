// What a frame is worth before anything is known about where it lies: is it blank, how sharp is it,
// how far did the view move since the frame before. From a thumbnail of the raw frame; about 2 ms
// for 800 x 640.
#pragma once

#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "simulation/scene/lens.h"

namespace arthro::authoring {

struct FrameLook {
  double brightness = 0;  // mean green inside the window, 0 to 255
  double redness = 1;     // mean red over mean green
  double spread = 0;      // of the light over the window: 5th to 95th percentile over the mean
  double detail = 0;      // standard deviation of what is finer and not noise, over the mean
  double sharpness = 0;   // of edges two to four raw pixels wide, over the mean; to compare only
  double moved = 0;       // since the frame before, share of the window's width; -1: cannot be told
  std::string blank;      // why nothing can be seen; "" when something can
};

// Looks at the frames of one clip in their order.
class FrameLooker {
 public:
  // Radius 0: the whole picture is window.
  explicit FrameLooker(const LensCircle& circle = {}) : circle_(circle) {}
  FrameLook Look(const cv::Mat& rgb);

 private:
  void MakeMask(cv::Size raw);

  LensCircle circle_;
  cv::Size raw_;
  cv::Mat mask_, weight_;     // CV_8UC1 and CV_32FC1, of the thumbnail
  cv::Rect middle_;           // square inside the window, for the motion
  cv::Mat taper_, previous_;  // CV_32FC1, of that square
};

// Frames that are blank for their clip though not by themselves: hardly any detail, and a light or
// a colour that no other frame has. Sets `blank`.
void MarkBlanks(std::vector<FrameLook>& looks);

}  // namespace arthro::authoring

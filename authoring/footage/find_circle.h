// The round window of an arthroscope in its raw pictures: where the lens shows tissue, and beyond
// it black. The sensor may cut its top, bottom or sides off, or a straight edge may flatten it.
//
// Found in each of some frames on its own, since on a camera with a loose coupler the window
// wanders (17 px on a real clip of 1280 x 720); what all of them show is the window of the clip.
// Where single frames are too dark at the rim, the brightest value of each pixel over the frames is
// looked at.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "simulation/scene/lens.h"

namespace arthro::authoring {

// `grey`: CV_8UC1. Radius 0 where there is no round window: a picture that is full to its corners,
// black throughout, or bounded by something that is not round. px, to about 0.3 px.
LensCircle FindCircle(const cv::Mat& grey);

struct ClipCircle {
  LensCircle circle;   // what every frame shows; radius 0: no round window
  double wanders = 0;  // px: how far the window's middle moves over the clip
  cv::Rect lit = {};   // the picture less black bars along its edges; empty: nothing is lit
};

class CircleFinder {
 public:
  // 8-bit RGB, 10 to 20 ms each; a dozen frames spread over the clip are enough. A frame of another
  // size than the first, or an empty one, is passed over.
  void Add(const cv::Mat& rgb);
  ClipCircle Find() const;

 private:
  ClipCircle FindRound() const;

  cv::Mat brightest_, grey_;
  std::vector<LensCircle> circles_;
  int frames_ = 0;
};

}  // namespace arthro::authoring

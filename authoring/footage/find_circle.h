// Finds the round window of an arthroscope in its raw pictures: the lens shows tissue inside it and
// black outside. The sensor may cut off the window's top, bottom or sides, and a straight edge may
// flatten it.
//
// The circle is found separately in several frames, because the window wanders on a camera with a
// loose coupler (17 px on a real clip of 1280 x 720). The window of the clip is the area that all
// frames show. When single frames are too dark at the rim, the detection uses the maximum of each
// pixel over the frames.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "simulation/scene/lens.h"

namespace arthro::authoring {

// `grey`: CV_8UC1. Returns radius 0 when there is no round window: the picture is full to its
// corners, black throughout, or bounded by another shape. Accuracy about 0.3 px.
LensCircle FindCircle(const cv::Mat& grey);

struct ClipCircle {
  LensCircle circle;   // area that every frame shows; radius 0: no round window
  double wanders = 0;  // px, range of the window's centre over the clip
  cv::Rect lit = {};   // picture without black bars along its edges; empty: nothing is lit
};

class CircleFinder {
 public:
  // Takes an 8-bit RGB frame in 10 to 20 ms. A dozen frames spread over the clip are enough.
  // Ignores an empty frame and a frame whose size differs from the first.
  void Add(const cv::Mat& rgb);
  ClipCircle Find() const;

 private:
  ClipCircle FindRound() const;

  cv::Mat brightest_, grey_;
  std::vector<LensCircle> circles_;
  int frames_ = 0;
};

}  // namespace arthro::authoring

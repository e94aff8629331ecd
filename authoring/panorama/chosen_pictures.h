// Raw pictures of chosen frames of a footage, in order; begins again after the last.
#pragma once

#include <set>

#include <opencv2/core.hpp>

#include "authoring/footage/footage.h"

namespace arthro::authoring {

class ChosenPictures {
 public:
  ChosenPictures(const Clips& clips, std::set<int> wanted)
      : footage_(Footage::Open(clips)), wanted_(std::move(wanted)) {}

  // Reads the next one, like FrameSource of compose.h.
  bool operator()(int& index, cv::Mat& rgb);

 private:
  Footage footage_;
  std::set<int> wanted_;
};

}  // namespace arthro::authoring

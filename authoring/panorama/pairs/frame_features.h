// The points of one frame that other frames may share, in rectified pixels at scale 1, with what
// they look like and an index to search them by. Found once a frame, searched by every pair.
#pragma once

#include <memory>
#include <vector>

#include <opencv2/core.hpp>

#include "authoring/panorama/frames/working_frame.h"
#include "authoring/panorama/pairs/feature_options.h"

namespace arthro::authoring {

struct FeatureMatch {
  int a = 0, b = 0;  // points of the two frames
};

class FrameFeatures {
 public:
  FrameFeatures();
  FrameFeatures(FrameFeatures&&) noexcept;
  FrameFeatures& operator=(FrameFeatures&&) noexcept;
  ~FrameFeatures();

  const std::vector<cv::Point2d>& points() const { return points_; }
  // Half the window's extent, px: what spread is measured against.
  double reach() const { return reach_; }

 private:
  friend FrameFeatures DetectFeatures(const WorkingFrame&, const FeatureOptions&);
  friend std::vector<FeatureMatch> MutualMatches(const FrameFeatures&, const FrameFeatures&,
                                                 const FeatureOptions&, const cv::Matx33d*);
  struct Index;

  std::vector<cv::Point2d> points_;
  cv::Mat descriptors_;  // CV_32F or CV_8U, one row a point
  std::unique_ptr<Index> index_;
  double reach_ = 0;
};

// Strongest first in every part of the frame, so that one vessel does not take them all. The same
// frame and options give the same points, at any number of threads. A frame without texture has
// none.
FrameFeatures DetectFeatures(const WorkingFrame& frame, const FeatureOptions& options);

// Each point of `a` with its nearest of `b`, when that is clearly nearer than the second and has it
// as its own nearest. With a prediction only matches in its reach. Safe to call from several
// threads.
std::vector<FeatureMatch> MutualMatches(const FrameFeatures& a, const FrameFeatures& b,
                                        const FeatureOptions& options,
                                        const cv::Matx33d* predicted_b_from_a);

}  // namespace arthro::authoring

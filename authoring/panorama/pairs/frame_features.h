// Points of one frame that other frames may share, in rectified pixels at scale 1, with descriptors
// and a search index. Computed once per frame, searched by every pair.
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
  // Half the window's extent, px: the unit of spread.
  double reach() const { return reach_; }

 private:
  friend FrameFeatures DetectFeatures(const WorkingFrame&, const FeatureOptions&);
  friend std::vector<FeatureMatch> MutualMatches(const FrameFeatures&, const FrameFeatures&,
                                                 const FeatureOptions&, const cv::Matx33d*);
  struct Index;

  std::vector<cv::Point2d> points_;
  cv::Mat descriptors_;  // CV_32F or CV_8U, one row per point
  std::unique_ptr<Index> index_;
  double reach_ = 0;
};

// Finds points, strongest first in every part of the frame, so that one vessel does not take them
// all. The same frame and options give the same points, for any number of threads. A frame without
// texture has none.
FrameFeatures DetectFeatures(const WorkingFrame& frame, const FeatureOptions& options);

// Matches each point of `a` with its nearest of `b` when that is clearly nearer than the second,
// and mutual. A prediction restricts matches to its neighbourhood. Safe to call from several
// threads.
std::vector<FeatureMatch> MutualMatches(const FrameFeatures& a, const FrameFeatures& b,
                                        const FeatureOptions& options,
                                        const cv::Matx33d* predicted_b_from_a);

}  // namespace arthro::authoring

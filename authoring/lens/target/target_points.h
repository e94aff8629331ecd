// Where a lattice point might be, and where exactly it is. Pictures are CV_32FC1, 0 to 1.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "authoring/lens/target/target_view.h"

namespace arthro::authoring {

// Places that look like a point of such a target at one scale (Gaussian sigma in px), the strongest
// first: saddles of a chessboard, dark spots where lines cross or where a dot lies. To about 0.5
// px.
std::vector<cv::Point2d> CandidatePoints(const cv::Mat& picture, TargetKind kind, double sigma);

// The point itself. Chessboard and lines: where all edges in the window would meet, since each
// gradient stands across its edge [Förstner & Gülch 1987]; the two edges of a line balance. Dots:
// the centre of darkness. `reach` is half the window, px; NaN where nothing can be made out.
class PointRefiner {
 public:
  PointRefiner(const cv::Mat& picture, TargetKind kind);
  cv::Point2d Refine(const cv::Point2d& start, double reach) const;

 private:
  cv::Point2d MeetingOfEdges(cv::Point2d at, double reach) const;
  cv::Point2d CentreOfDarkness(cv::Point2d at, double reach) const;

  TargetKind kind_;
  cv::Mat picture_, gradient_x_, gradient_y_;
};

}  // namespace arthro::authoring

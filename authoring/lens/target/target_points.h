// Candidates for lattice points, and their exact positions. Pictures are CV_32FC1, 0 to 1.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "authoring/lens/target/target_view.h"

namespace arthro::authoring {

// Positions that resemble a point of such a target at one scale (Gaussian sigma in px), the
// strongest first: saddles of a chessboard, or dark spots at a crossing of lines or at a dot.
// Accuracy about 0.5 px.
std::vector<cv::Point2d> CandidatePoints(const cv::Mat& picture, TargetKind kind, double sigma);

// Exact position of a point. Chessboard and lines: the point that best lies on all edges in the
// window, since each gradient is perpendicular to its edge [Förstner & Gülch 1987]; the two edges
// of a line balance. Dots: the centroid of darkness. `reach` is half the window, px; the result is
// NaN when nothing can be found.
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

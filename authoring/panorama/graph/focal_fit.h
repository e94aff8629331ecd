// Is the lens's focal length right? A wrong one rectifies wrongly: every pair bends a little, and
// the frames together follow neither their pairs nor the camera's rule (camera_prior.h) as well as
// they could. The pairs' control points are taken back through the lens and out again with another
// focal length, all frames are placed anew, and the length at which they agree best is found. It
// needs no picture a second time.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "authoring/lens/rectifier.h"
#include "authoring/panorama/graph/refinement/refine.h"
#include "authoring/panorama/pairs/pair_estimate.h"
#include "simulation/scene/lens.h"

namespace arthro::authoring {

// Where rectified pixels would lie had the lens `factor` times its focal length. The new view has
// the same centre and `factor` times the focal length.
class FocalChange {
 public:
  FocalChange(const Lens& lens, const RectifiedView& view, double factor);
  cv::Point2d Apply(const cv::Point2d& rectified) const;
  cv::Matx22d Derivative(const cv::Point2d& rectified) const;
  PairEstimate Apply(const PairEstimate& pair) const;
  // plane_from_frame of the frame as it would be rectified.
  cv::Matx33d Apply(const cv::Matx33d& plane_from_frame) const;
  Pinhole camera() const;  // of the new view

 private:
  Lens lens_, other_;
  RectifiedView view_;
  double factor_ = 1;
};

struct FocalFit {
  // By what the focal length must be multiplied for the pairs to agree best, within 12 %, and its
  // standard deviation.
  double factor = 1, deviation = 0;
  // False: the frames could lie as well with quite another focal length (they hardly move, or are
  // too few), and the factor is 1.
  bool is_determined = false;
};

// Of the frames that hang together with `root`.
FocalFit FitFocal(int frames, const std::vector<PairEstimate>& pairs, int root, const Lens& lens,
                  const RectifiedView& view, const RefineOptions& options);

// How far the worst of `points` of each frame would move, px of the plane, if the frames were
// placed with the other focal length, after the homography of the plane that brings the two closest
// together. 0 for frames that do not hang together with `root`.
std::vector<double> FocalErrors(const std::vector<cv::Matx33d>& plane_from_frame,
                                const std::vector<PairEstimate>& pairs, int root,
                                const FocalChange& change, const std::vector<cv::Point2d>& points,
                                const RefineOptions& options);

}  // namespace arthro::authoring

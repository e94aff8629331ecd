// Checks the lens's focal length. A wrong one rectifies wrongly: every pair is distorted a little,
// and the frames satisfy neither their pairs nor the camera's rule (camera_prior.h) as well as they
// could. The control points of the pairs are mapped back through the lens and out again with
// another focal length, and all frames are placed again. The fit finds the length of best
// agreement. It reads no pictures.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "authoring/lens/rectifier.h"
#include "authoring/panorama/graph/refinement/refine.h"
#include "authoring/panorama/pairs/pair_estimate.h"
#include "simulation/scene/lens.h"

namespace arthro::authoring {

// Positions of rectified pixels for a lens with `factor` times its focal length. The new view has
// the same centre and `factor` times the focal length.
class FocalChange {
 public:
  FocalChange(const Lens& lens, const RectifiedView& view, double factor);
  cv::Point2d Apply(const cv::Point2d& rectified) const;
  cv::Matx22d Derivative(const cv::Point2d& rectified) const;
  PairEstimate Apply(const PairEstimate& pair) const;
  // Returns plane_from_frame for the frame as rectified with the other length.
  cv::Matx33d Apply(const cv::Matx33d& plane_from_frame) const;
  Pinhole camera() const;  // camera of the new view

 private:
  Lens lens_, other_;
  RectifiedView view_;
  double factor_ = 1;
};

struct FocalFit {
  // Factor on the focal length for the best agreement of the pairs, within 12 %, and its standard
  // deviation.
  double factor = 1, deviation = 0;
  // False: another focal length fits as well, because the frames hardly move or are too few. The
  // factor is then 1.
  bool is_determined = false;
};

// Fits the frames that are connected with `root`.
FocalFit FitFocal(int frames, const std::vector<PairEstimate>& pairs, int root, const Lens& lens,
                  const RectifiedView& view, const RefineOptions& options);

// Distance by which the worst of `points` of each frame would move with the other focal length, px
// of the plane, after the homography of the plane that brings the two closest together. 0 for
// frames that are not connected with `root`.
std::vector<double> FocalErrors(const std::vector<cv::Matx33d>& plane_from_frame,
                                const std::vector<PairEstimate>& pairs, int root,
                                const FocalChange& change, const std::vector<cv::Point2d>& points,
                                const RefineOptions& options);

}  // namespace arthro::authoring

// All homographies of a component at once: the frames' places in one plane that agree best, in the
// sense of each pair's own covariance, with every pair estimate. Sparse Levenberg-Marquardt with
// analytic derivatives (Ceres), robust against pairs that are off. One frame stays fixed, since a
// homography of the whole plane changes no pair.
#pragma once

#include <optional>
#include <vector>

#include <opencv2/core.hpp>

#include "authoring/panorama/graph/refinement/pinhole.h"
#include "authoring/panorama/pairs/pair_estimate.h"
#include "simulation/core/options.h"

namespace arthro::authoring {

struct RefineOptions {
  double pair_floor = 0.03;
  double loss_scale = 3.0;
  int refine_iterations = 40;
  double camera_deviation = 0.0005;
  template <class V>
  void Visit(V&& v) {
    v("pair_floor", pair_floor, Range{0.0, 2.0}, "px",
      "Error that no pair is free of, beside what its own covariance says.");
    v("loss_scale", loss_scale, Range{1.0, 100.0}, "",
      "Times its expected error at which a pair begins to lose weight (Cauchy).");
    v("camera_deviation", camera_deviation, Range{0.0, 1.0}, "",
      "How far a frame may stray from what a calibrated scope sees of a plane; widened where the "
      "tissue is not flat. 0: any homography will do.");
    v("refine_iterations", refine_iterations, Range{1, 1000}, "", "Steps before giving up.");
  }
};

struct Refined {
  // Of the frames that a pair joins to the fixed one; the others keep their start.
  std::vector<cv::Matx33d> plane_from_frame;
  // In the order of the pairs: rms distance of the four control points, px, and the whitened
  // residual's norm over what it should be (1 is as expected).
  std::vector<double> pair_error_px, pair_surprise;
  double variance_factor = 1;   // by how much the pairs' covariances are too small
  double camera_deviation = 0;  // of the prior in the end; 0: none
  int iterations = 0;
};

enum class RefineSolver { kSparse, kDense };  // dense: the reference that tests compare with

// `start` maps every frame to one plane. Pairs whose control points fall behind a frame at the
// start take no part (surprise: infinity). With a camera, homographies are those that it can see as
// far as the pairs agree (camera_prior.h); then the plane is one of straight metric near that in
// which the start is stretched least, and the fixed frame keeps only its position, turn and size.
Refined Refine(const std::vector<PairEstimate>& pairs, const std::vector<cv::Matx33d>& start,
               int fixed_frame, const RefineOptions& options,
               const std::optional<Pinhole>& camera = std::nullopt,
               RefineSolver solver = RefineSolver::kSparse);

// How ill pairs and camera agree, in half squared deviations, robust: to compare cameras. The prior
// keeps its deviation, and `pair_factor` is the variance factor. `places` become the refined ones.
double CameraMisfit(const std::vector<PairEstimate>& pairs, int fixed_frame,
                    const RefineOptions& options, const Pinhole& camera, double pair_factor,
                    std::vector<cv::Matx33d>* places);

}  // namespace arthro::authoring

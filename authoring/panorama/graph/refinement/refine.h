// Refines all homographies of a component together: the frames' positions in one plane that agree
// best with every pair estimate, weighted by its covariance. Sparse Levenberg-Marquardt with
// analytic derivatives (Ceres), robust against outlying pairs. One frame stays fixed, since a
// homography of the whole plane changes no pair.
#pragma once

#include <optional>
#include <vector>

#include <opencv2/core.hpp>

#include "authoring/panorama/graph/refinement/pinhole.h"
#include "authoring/panorama/graph/refinement/refine_options.h"
#include "authoring/panorama/pairs/pair_estimate.h"

namespace arthro::authoring {

struct Refined {
  // Positions of the frames that pairs connect with the fixed one; the others keep their start.
  std::vector<cv::Matx33d> plane_from_frame;
  // Residuals in the order of the pairs: rms distance of the four control points, px, and the norm
  // of the whitened residual over its expectation.
  std::vector<double> pair_error_px, pair_surprise;
  double variance_factor = 1;   // factor by which the pairs' covariances are too small
  double camera_deviation = 0;  // final deviation of the prior; 0: none
  int iterations = 0;
};

enum class RefineSolver { kSparse, kDense };  // dense: the reference that tests compare with

// `start` maps every frame to one plane. Pairs whose control points fall behind a frame at the
// start are ignored (surprise: infinity). With a camera, homographies obey its rule as far as the
// pairs agree (camera_prior.h). The plane then has a straight metric and is near the one in which
// the start is distorted least; the fixed frame keeps only its position, rotation and size.
Refined Refine(const std::vector<PairEstimate>& pairs, const std::vector<cv::Matx33d>& start,
               int fixed_frame, const RefineOptions& options,
               const std::optional<Pinhole>& camera = std::nullopt,
               RefineSolver solver = RefineSolver::kSparse);

// Disagreement of pairs and camera, in half squared deviations, robust: for comparing cameras. The
// prior keeps its deviation, and `pair_factor` is the variance factor. `places` become the refined
// ones.
double CameraMisfit(const std::vector<PairEstimate>& pairs, int fixed_frame,
                    const RefineOptions& options, const Pinhole& camera, double pair_factor,
                    std::vector<cv::Matx33d>* places);

}  // namespace arthro::authoring

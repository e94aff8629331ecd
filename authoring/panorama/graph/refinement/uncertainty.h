// Uncertainty of each frame's position, from the covariances of its pairs.
//
// Linearised at the refined positions: N = sum of J^T J over the whitened pairs, one frame fixed. A
// point p of frame i lies at q = pi(M_i p), off by J_ip x_i. A homography of the whole plane is no
// error, since the plane is free. The best such homography over all points of all frames, g = B x,
// is therefore removed: e = J x_i - Q g.
//
// Its covariance needs the diagonal blocks of inv(N), by Takahashi's recursion over the sparse
// factor, linear in the frames for a chain with loops, and inv(N) B^T, eight solves.
#pragma once

#include <optional>
#include <vector>

#include <opencv2/core.hpp>

#include "authoring/panorama/graph/refinement/pinhole.h"
#include "authoring/panorama/pairs/pair_estimate.h"

namespace arthro::authoring {

struct Uncertainty {
  // Radius that contains the error of each frame's worst point with 95 % probability, px of the
  // plane. Infinity for a frame without constraints.
  std::vector<double> error_px;
  // Share of each pair's eight numbers that the rest of the graph checks, from 0 (none) to 1.
  std::vector<double> pair_checked;
};

// `points`: those of a frame at which errors count. Frames without pairs are left out. A camera and
// its deviation add the prior of camera_prior.h; the positions must then lie in a plane of straight
// metric. `weights` multiply the information of each pair (the robust loss's, over the variance
// factor).
Uncertainty EstimateUncertainty(const std::vector<PairEstimate>& pairs,
                                const std::vector<double>& weights,
                                const std::vector<cv::Matx33d>& plane_from_frame, int fixed_frame,
                                const std::vector<cv::Point2d>& points, double pair_floor_px,
                                const std::optional<Pinhole>& camera = std::nullopt,
                                double camera_deviation = 0);

}  // namespace arthro::authoring

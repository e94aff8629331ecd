// How well each frame's place is known, from the covariances of the pairs that hold it.
//
// Linearised at the refined places: N = sum of J^T J over the whitened pairs, one frame fixed. A
// point p of frame i lies at q = pi(M_i p), off by J_ip x_i. What one homography of the whole plane
// could take away is no error (nobody knows where the plane begins), so the best such homography
// over all points of all frames, g = B x, is taken away first: e = J x_i - Q g. Its covariance
// needs the diagonal blocks of inv(N), by Takahashi's recursion over the sparse factor, linear in
// the frames for a chain with loops, and inv(N) B^T, eight solves.
#pragma once

#include <optional>
#include <vector>

#include <opencv2/core.hpp>

#include "authoring/panorama/graph/refinement/pinhole.h"
#include "authoring/panorama/pairs/pair_estimate.h"

namespace arthro::authoring {

struct Uncertainty {
  // Radius within which the worst point of each frame lies with 95 % probability, px of the plane.
  // Infinity where nothing holds the frame.
  std::vector<double> error_px;
  // Share of each pair's eight numbers that the rest of the graph checks, 0 (nothing does) to 1.
  std::vector<double> pair_checked;
};

// `points` are those of a frame at which errors count. Frames that no pair holds take no part.
// With a camera and its deviation, the prior of camera_prior.h holds too; then the places must lie
// in a plane of straight metric. `weights` multiply the information of each pair (the robust
// loss's, over the variance factor).
Uncertainty EstimateUncertainty(const std::vector<PairEstimate>& pairs,
                                const std::vector<double>& weights,
                                const std::vector<cv::Matx33d>& plane_from_frame, int fixed_frame,
                                const std::vector<cv::Point2d>& points, double pair_floor_px,
                                const std::optional<Pinhole>& camera = std::nullopt,
                                double camera_deviation = 0);

}  // namespace arthro::authoring

// Finds the position of frame b over frame a without a start. Correlates their coarsest bands over
// all shifts (Fourier) for several rotations and zooms, then improves each of the best peaks by
// least squares at that level. Homographies b_from_a are of rectified px.
#pragma once

#include <optional>
#include <vector>

#include <opencv2/core.hpp>

#include "authoring/panorama/pairs/direct_pyramid.h"

namespace arthro::authoring {

struct CoarseCandidate {
  cv::Matx33d b_from_a;
  double similarity = 0, certainty = 0, overlap = 0;  // see Evidence; at the coarsest level
  // Rank: the certainty, reduced when only part of the shared view is similar.
  double score = 0;
};

// Candidates, best first, all different. Empty for a frame without texture. `predicted` (may be
// null) narrows the search to rotations near it.
std::vector<CoarseCandidate> CoarseCandidates(const DirectPyramid& a, const DirectPyramid& b,
                                              const cv::Matx33d* predicted,
                                              const DirectOptions& options);

// Best candidate.
std::optional<cv::Matx33d> CoarseAlign(const DirectPyramid& a, const DirectPyramid& b,
                                       const cv::Matx33d* predicted, const DirectOptions& options);

}  // namespace arthro::authoring

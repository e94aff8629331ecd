// Where frame b may lie over frame a, found without a start: correlation of their coarsest bands
// over all shifts at once (Fourier), for several turns and zooms, then each of the best peaks
// improved by least squares at that level. Homographies b_from_a are of rectified px.
#pragma once

#include <optional>
#include <vector>

#include <opencv2/core.hpp>

#include "authoring/panorama/pairs/direct_pyramid.h"

namespace arthro::authoring {

struct CoarseCandidate {
  cv::Matx33d b_from_a;
  double similarity = 0, certainty = 0, overlap = 0;  // as in Evidence, coarsest level
  // What ranks: the certainty, less where only part of the shared view looks alike.
  double score = 0;
};

// Best first, no two alike. Empty when a frame has no texture. `predicted` (may be null) narrows
// the search to turns near it.
std::vector<CoarseCandidate> CoarseCandidates(const DirectPyramid& a, const DirectPyramid& b,
                                              const cv::Matx33d* predicted,
                                              const DirectOptions& options);

// The best of them.
std::optional<cv::Matx33d> CoarseAlign(const DirectPyramid& a, const DirectPyramid& b,
                                       const cv::Matx33d* predicted, const DirectOptions& options);

}  // namespace arthro::authoring

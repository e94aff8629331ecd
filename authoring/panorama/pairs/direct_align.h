// Lays frame b over frame a by all of their pixels at once, where single points are too faint to be
// found again: coarse-to-fine least squares over the bands of a DirectPyramid, with a covariance
// that counts the noise as the frames show it, and a verdict.
#pragma once

#include <optional>
#include <string>

#include "authoring/panorama/pairs/coarse_align.h"
#include "authoring/panorama/pairs/direct_pyramid.h"
#include "authoring/panorama/pairs/pair_estimate.h"

namespace arthro::authoring {

// `start_b_from_a` may be off by some 40 rectified px. Nothing, and `why_not` says why, when the
// frames do not show the same place as far as can be told.
std::optional<PairEstimate> AlignDirect(const DirectPyramid& a, const DirectPyramid& b, int ia,
                                        int ib, const cv::Matx33d& start_b_from_a,
                                        const DirectOptions& options, std::string* why_not);

}  // namespace arthro::authoring

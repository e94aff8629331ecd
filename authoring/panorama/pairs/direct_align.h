// Aligns frame b with frame a by all of their pixels, when single points are too faint to be found
// again. Coarse-to-fine least squares over the bands of a DirectPyramid, with a covariance from the
// noise of the frames, and a verdict.
#pragma once

#include <optional>
#include <string>

#include "authoring/panorama/pairs/coarse_align.h"
#include "authoring/panorama/pairs/direct_pyramid.h"
#include "authoring/panorama/pairs/pair_estimate.h"

namespace arthro::authoring {

// `start_b_from_a` may be off by about 40 rectified px. Returns nothing, with the reason in
// `why_not`, unless the frames demonstrably show the same place.
std::optional<PairEstimate> AlignDirect(const DirectPyramid& a, const DirectPyramid& b, int ia,
                                        int ib, const cv::Matx33d& start_b_from_a,
                                        const DirectOptions& options, std::string* why_not);

}  // namespace arthro::authoring

// Relates a pair of frames by common points [paper, 3.1]: matches by descriptor, RANSAC,
// refinement, and the accuracy of the result.
#pragma once

#include <optional>
#include <string>

#include "authoring/panorama/pairs/frame_features.h"
#include "authoring/panorama/pairs/pair_estimate.h"

namespace arthro::authoring {

// Returns nothing when the frames do not match; `why_not`, which may be null, then gives the reason
// in a few words. `overlap` is that of the two windows' boxes; `similarity` is unknown for points
// and stays 0. Safe to call from several threads.
std::optional<PairEstimate> MatchFeatures(const FrameFeatures& a, const FrameFeatures& b, int ia,
                                          int ib, const FeatureOptions& options,
                                          std::string* why_not,
                                          const cv::Matx33d* predicted_b_from_a = nullptr);

}  // namespace arthro::authoring

// A pair of frames held together by the points that they share [paper, 3.1]: matches by look,
// agreed by RANSAC, refined; with how well that pins the pair down.
#pragma once

#include <optional>
#include <string>

#include "authoring/panorama/pairs/frame_features.h"
#include "authoring/panorama/pairs/pair_estimate.h"

namespace arthro::authoring {

// Nothing when the frames do not hold together; `why_not`, which may be null, then says why in a
// few words. `overlap` is that of the two windows' boxes; `similarity` is not known from points and
// stays 0. Safe to call from several threads.
std::optional<PairEstimate> MatchFeatures(const FrameFeatures& a, const FrameFeatures& b, int ia,
                                          int ib, const FeatureOptions& options,
                                          std::string* why_not,
                                          const cv::Matx33d* predicted_b_from_a = nullptr);

}  // namespace arthro::authoring

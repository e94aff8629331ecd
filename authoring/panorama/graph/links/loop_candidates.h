// Chooses the next pairs to try: their frames overlap by the current positions, and the graph
// constrains their relative position least.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "authoring/panorama/graph/links/frame_window.h"
#include "authoring/panorama/graph/links/pair_book.h"
#include "authoring/panorama/pairs/pair_estimate.h"

namespace arthro::authoring {

struct LoopLimits {
  int most_pairs = 0;      // in this round, for the whole clip
  int most_per_frame = 3;  // in this round
  double smallest_overlap = 0.35;
  double least_gain = 0.3;
};

// `plane_from_frame` and `piece` of every frame (-1: none); only frames of one piece can be
// predicted. Pairs that were tried before are not requested again.
std::vector<PairRequest> LoopCandidates(const std::vector<cv::Matx33d>& plane_from_frame,
                                        const std::vector<int>& piece, const PairBook& book,
                                        const FrameWindow& window, const LoopLimits& limits);

}  // namespace arthro::authoring

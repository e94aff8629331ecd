// Which pairs to try next: those whose frames overlap as far as the current places tell and that
// the graph knows least about each other.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "authoring/panorama/graph/frame_window.h"
#include "authoring/panorama/graph/pair_book.h"
#include "authoring/panorama/pairs/pair_estimate.h"

namespace arthro::authoring {

struct LoopLimits {
  int most_pairs = 0;      // in this round, of the whole clip
  int most_per_frame = 3;  // in this round
  double smallest_overlap = 0.35;
  double least_gain = 0.3;
};

// `plane_from_frame` and `piece` of every frame (-1: none); only frames of one piece can be
// predicted. Pairs that the book has tried are not asked for again.
std::vector<PairRequest> LoopCandidates(const std::vector<cv::Matx33d>& plane_from_frame,
                                        const std::vector<int>& piece, const PairBook& book,
                                        const FrameWindow& window, const LoopLimits& limits);

}  // namespace arthro::authoring

// Attempts for consecutive frames that could not be aligned: the motion of the neighbouring pairs,
// steps over the gap, and a search without prediction. A frame that stays alone is compared with
// every placed frame that should show the same tissue.
#pragma once

#include <string_view>
#include <vector>

#include <opencv2/core.hpp>

#include "authoring/panorama/graph/links/frame_window.h"
#include "authoring/panorama/graph/links/pair_book.h"

namespace arthro::authoring {

// `usable` are the frames that can be placed, ascending. At most `searches` searches per gap.
void RepairGaps(const std::vector<int>& usable, int frames, int searches, PairBook& book,
                const Progress& progress);

// Predicts frames whose piece is not `main` from the placed frames before and after them, by the
// same motion, and compares them with the `main` frames of the largest predicted overlap. Returns
// the number of pairs found.
int AdoptOrphans(const std::vector<int>& usable, const std::vector<cv::Matx33d>& plane_from_frame,
                 const std::vector<int>& piece, int main, const FrameWindow& window, PairBook& book,
                 const Progress& progress);

}  // namespace arthro::authoring

// What is tried where two frames that follow one another do not agree: the motion of the pairs
// beside them, steps over the gap, a search from nothing; and for frames that stay alone, every
// placed frame that should show the same tissue.
#pragma once

#include <string_view>
#include <vector>

#include <opencv2/core.hpp>

#include "authoring/panorama/graph/frame_window.h"
#include "authoring/panorama/graph/pair_book.h"

namespace arthro::authoring {

// `usable` are the frames that can be placed, ascending. At most `searches` searches a gap.
void RepairGaps(const std::vector<int>& usable, int frames, int searches, PairBook& book,
                const Progress& progress);

// Frames whose piece is not `main` are guessed from the placed frames before and after them (the
// same motion goes on), and tried against those `main` frames that the guess overlaps most.
// Returns how many pairs were found.
int AdoptOrphans(const std::vector<int>& usable, const std::vector<cv::Matx33d>& plane_from_frame,
                 const std::vector<int>& piece, int main, const FrameWindow& window, PairBook& book,
                 const Progress& progress);

}  // namespace arthro::authoring

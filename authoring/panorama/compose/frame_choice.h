// Choice of one frame per cell, where the mean of several would lose the detail.
//
// The mean of frames that lie a few pixels off each other has no fine structure: parallax, and
// tissue that moves, leave such residues in real clips.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "authoring/panorama/compose/consensus.h"

namespace arthro::authoring {

// Share of a mean of several frames in cells that this frame shows; the rest is one frame's. The
// neighbours of a frame share most of its expected error, so that a mean loses detail at errors of
// several px only.
double ShareOfMean(const LaidFrame& frame);

// Root mean square detail of each frame over that of all frames at its cells: a frame that moved
// fast, or is out of focus, has less than 1. 1 for frames that were not read.
std::vector<double> SharpnessOf(const std::vector<FrameCells>& cells, const Layout& layout,
                                const Progress& progress);

// Position of the chosen frame in the layout per cell, CV_16SC1, -1 where no frame shows the cell.
// A cell takes a frame of high `score` (CV_32FC1 over each frame's box); borders between two frames
// run where both have similar colours [Kwatra et al. 2003, the seam cost].
cv::Mat ChooseFrames(const std::vector<FrameCells>& cells, const std::vector<cv::Mat>& score,
                     const Layout& layout, const Progress& progress);

}  // namespace arthro::authoring

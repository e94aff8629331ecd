// Weights of the frames at each cell, as shares that add up to 1.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "authoring/panorama/compose/consensus.h"

namespace arthro::authoring {

// One CV_8UC1 picture per frame, over the frame's box in cells; 255 is a share of 1. Rounding lets
// a cell's shares deviate slightly from a sum of 1. Empty for frames that were not read.
std::vector<cv::Mat> ShareCells(const std::vector<FrameCells>& cells,
                                const std::vector<CellRays>& rays, const Layout& layout,
                                const ComposeOptions& options, const Progress& progress);

}  // namespace arthro::authoring

// Which frames each cell is taken from, as shares that add up to 1.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "authoring/panorama/compose/consensus.h"

namespace arthro::authoring {

// By frame, CV_8UC1 over the frame's box in cells; 255 is the whole of it (rounded, so that a
// cell's shares add up to 1 only about). Empty for frames not seen.
std::vector<cv::Mat> ShareCells(const std::vector<FrameCells>& cells,
                                const std::vector<CellRays>& rays, const Layout& layout,
                                const ComposeOptions& options, const Progress& progress);

}  // namespace arthro::authoring

// Low frequencies of the panorama: the frames' cells, blended in bands so that no step remains at
// the seams between frames [Burt & Adelson 1983].
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "authoring/panorama/compose/consensus.h"

namespace arthro::authoring {

// CV_32FC3 over the grid of cells, grey levels. Takes the consensus for cells without a share.
cv::Mat BlendCells(const std::vector<FrameCells>& cells, const std::vector<cv::Mat>& shares,
                   const Consensus& consensus, const Layout& layout, const Progress& progress);

// A frame's own cells as CV_32FC3; cells that it does not show are taken from the consensus.
cv::Mat FilledCells(const FrameCells& cells, const Consensus& consensus, const cv::Rect& box);

}  // namespace arthro::authoring

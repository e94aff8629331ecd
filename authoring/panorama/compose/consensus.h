// Consensus of the frames at each cell, and the agreement of each frame with it. Debris, tool and
// highlights move relative to the tissue, so they are a minority among the frames that see a cell.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "authoring/panorama/compose/frame_cells.h"
#include "simulation/core/progress.h"

namespace arthro::authoring {

struct Consensus {
  cv::Mat colour;    // CV_32FC3, grey levels; unknown cells are filled smoothly
  cv::Mat is_known;  // CV_8UC1, 255: seen well by a frame; 128: only overexposed; 0: not seen
  double outlier_share = 0;  // share of the frames' cells
  double residue = 0;        // grey levels: median distance of cells that agree
};

// Samples (frame, and row and column in its box) of one cell after another, row by row.
template <class F>
void ForEachCell(const std::vector<FrameCells>& cells, const Layout& layout, int row, F&& visit) {
  std::vector<int> here, views;
  for (std::size_t f = 0; f < cells.size(); ++f) {
    const cv::Rect& box = layout.frames[f].cells;
    if (cells[f].is_seen() && row >= box.y && row < box.y + box.height)
      here.push_back(static_cast<int>(f));
  }
  for (int x = 0; x < layout.cells.width; ++x) {
    views.clear();
    for (const int f : here) {
      const cv::Rect& box = layout.frames[f].cells;
      if (x >= box.x && x < box.x + box.width &&
          cells[f].blend_weight.at<uchar>(row - box.y, x - box.x) > 0)
        views.push_back(f);
    }
    if (!views.empty()) visit(x, views);
  }
}

// Lowers the blend weight of cells that disagree with the consensus.
Consensus FindConsensus(std::vector<FrameCells>& cells, const std::vector<CellRays>& rays,
                        const Layout& layout, const ComposeOptions& options,
                        const Progress& progress);

// Fills unknown cells (`is_known` zero) smoothly from their surroundings.
void FillSmoothly(cv::Mat& colour, const cv::Mat& is_known);

}  // namespace arthro::authoring

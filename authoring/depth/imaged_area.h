// Area of a panorama that shows tissue: without the black surround that touches the picture's edge,
// its dim rim, and the holes that a mosaic left black.
#pragma once

#include <cstdint>
#include <vector>

#include "authoring/depth/grey_plane.h"

namespace arthro::authoring {

// Pixels of a row that have a flag: [first, last).
struct Run {
  int first = 0, last = 0;
};
using RowRuns = std::vector<std::vector<Run>>;

RowRuns RunsOf(const std::vector<std::uint8_t>& flags, int width, int height, PixelFlag flag);

// Selects the dark runs that are surround: connected (up, down, left, right) to the picture's edge,
// or a hole of pure black. A dark recess inside the joint is tissue.
RowRuns SurroundOf(const RowRuns& dark, const std::vector<std::uint8_t>& flags, int width,
                   int height);

// 1 within `margin` pixels (chessboard distance) of a run, else 0.
std::vector<std::uint8_t> Grow(const RowRuns& runs, int width, int height, int margin);

}  // namespace arthro::authoring

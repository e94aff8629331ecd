// Which pixels of a panorama show tissue: not the black surround that is joined to the picture's
// edge, not its dim rim, not the holes that a mosaic left black. And where glints have wiped the
// tissue out.
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

// Of all dark runs those that are surround: joined (up, down, left, right) to the picture's edge,
// or a hole of pure black. A dark recess inside the joint is tissue.
RowRuns SurroundOf(const RowRuns& dark, const std::vector<std::uint8_t>& flags, int width,
                   int height);

// 1 within `margin` pixels (chessboard distance) of a run, else 0.
std::vector<std::uint8_t> Grow(const RowRuns& runs, int width, int height, int margin);

}  // namespace arthro::authoring

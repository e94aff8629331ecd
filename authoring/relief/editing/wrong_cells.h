// Cells of a relief that its author marks as wrong. The surface is closed over them from their
// surround, and they count as interpolated.
#pragma once

#include <cstdint>
#include <vector>

#include "authoring/relief/editing/relief_view.h"

namespace arthro::authoring {

// One flag per cell, row by row.
struct CellMarks {
  int width = 0, height = 0;
  std::vector<std::uint8_t> is_marked;

  CellMarks() = default;
  CellMarks(int w, int h)
      : width(w), height(h), is_marked(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
};

// Marks the cells within `radius` px of the line from `from` to `to`. Returns how many are new.
int MarkAlong(const glm::dvec2& from, const glm::dvec2& to, double radius, CellMarks& marks);

// The same relief with other values in the marked cells.
struct ClosedRelief {
  DepthMap relief, sigma;  // m; sigma is empty where it was
  OriginMap origin;        // kInterpolated in the marked cells; empty where it was
};

// Spans a membrane over the marked cells: every value is the mean of its neighbours. Its standard
// error is that of the border and grows with the distance from it. A marked cell that was unknown
// stays unknown; marked cells without a known neighbour become unknown.
ClosedRelief CloseMarked(const ReliefView& view, const CellMarks& marks);

}  // namespace arthro::authoring

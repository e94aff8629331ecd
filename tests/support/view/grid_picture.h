// A panorama of thin grid lines, and the sub-pixel distance of each rendered line from its closed
// form [method.md, Oblique view; paper, 3.3, Fig. 7], in pixels of the picture. Channels keep the
// parts apart: red holds the vertical lines (u = k·spacing), green the horizontal ones (v =
// k·spacing), blue one level a cell that no neighbour shares, so that a picture that is off by a
// whole cell is caught too.
#pragma once

#include <vector>

#include <glm/vec2.hpp>

#include "simulation/scene/image.h"
#include "simulation/scene/lens.h"
#include "simulation/scene/scene.h"
#include "simulation/scope/arthroscope.h"

namespace arthro::test {

struct GridPanorama {
  int width = 2048, height = 1024;
  double spacing = 64;      // panorama px between lines
  double line_sigma = 2.0;  // panorama px; the lines have a Gaussian profile

  ColourImage Draw() const;
  int CellLevel(const glm::dvec2& pixel) const;  // the blue of the cell a panorama pixel lies in
};

// A bright line crossed by a row or a column of the picture.
struct LineCrossing {
  glm::dvec2 pixel{0.0};  // sub-pixel along the scan
  int channel = 0;        // 0 red: a vertical line of the panorama; 1 green: a horizontal one
  bool along_row = true;
};

// All crossings where the channel peaks above `threshold` (0 to 255); the position is that of the
// parabola through the logarithms of the peak and its neighbours, exact for a Gaussian profile.
std::vector<LineCrossing> FindLineCrossings(const ColourImage& picture, int threshold = 80);

struct GridAgreement {
  int crossings = 0;  // compared
  double rms_px = 0, max_px = 0;
  glm::dvec2 worst{0.0};           // pixel of the picture
  int cells = 0, wrong_cells = 0;  // pixels well inside a cell, and those of a wrong level
};

// Holds a square rendered picture against the closed form. Crossings that a scan meets at less than
// 45 degrees are left to the other scan; a margin at the window's rim is left out.
GridAgreement CompareWithGrid(const ColourImage& picture, const GridPanorama& grid,
                              const Backdrop& backdrop, const simulation::ScopeView& view,
                              double field_of_view, double rim_px = 4.0,
                              const Lens* lens = nullptr);

}  // namespace arthro::test

// Weighted sums over a growing kernel about each pixel of a map, for the plane that fits its
// heights best. Beside a hole the kernel lies to one side, and the plane leads back from its centre
// of mass. Heights in m, places in px.
#pragma once

#include <array>

#include "simulation/haptics/relief/plane_filters.h"

namespace arthro::simulation {

// Place of a map within a larger one, px. Filters of a part give the bytes that they give in the
// whole, away from the edges of the part.
struct MapFrame {
  int left = 0, top = 0;
  int width = 0, height = 0;  // size of the whole
};

class PlaneMoments {
 public:
  // `mass`, and `height` times mass, over a kernel that is one pixel wide.
  PlaneMoments(FloatPlane mass, const FloatPlane& height, int map_width, int map_height,
               const MapFrame& frame);

  std::array<FloatPlane*, 8> All() { return {&m_, &x_, &y_, &xx_, &xy_, &yy_, &hx_, &hy_}; }

  // Heights of the planes at the pixels from `first` to `last` of a row. Of a pixel without mass it
  // is no number. `height`: the sum of height times mass over the same kernel.
  void PlanesAt(const FloatPlane& height, int row, int first, int last, float* heights) const;

 private:
  int width_;
  MapFrame frame_;
  float centre_x_, centre_y_;
  FloatPlane m_, x_, y_, xx_, xy_, yy_, hx_, hy_;
};

}  // namespace arthro::simulation

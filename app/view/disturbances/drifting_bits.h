// Bubbles and loose tissue at one moment: closed functions of seed, time and view, so that any
// moment can be drawn without those before it. Drifting bits have their places in the portal frame,
// in a periodic box of fluid that moves with the lens, so that they pass by as the scope moves;
// bits on the lens have their places in the picture.
#pragma once

#include <vector>

#include <glm/vec2.hpp>

#include "app/view/drawing/disturbances.h"
#include "app/view/shaders/constants.h"
#include "simulation/scope/arthroscope.h"
#include "simulation/scope/window_lens.h"

namespace arthro::app {

struct DriftingBit {
  glm::dvec2 centre{0.0};  // place in the window, window radii, x right, y up
  double radius = 0;       // radius of its disc, window radii
  double distance = 0;     // from the lens, m
  double angle = 0;        // angle of its longer side in the picture, rad
  double shape = 0;        // 0 to 1, selects the shape; flakes below kFibreShare are fibres
  double opacity = 1;
  double softness = 0;  // width of its edge by defocus, in its radii
};

// Number of bits for a strength, at least one for a strength above 0. Not all are in sight.
int BubbleCount(double strength);
int FlakeCount(double strength);
int FleckCount(double share);

// Bits in sight, the farthest first.
std::vector<DriftingBit> Bubbles(const Disturbances& disturbances,
                                 const simulation::ScopeView& view, double field_of_view,
                                 const simulation::WindowLens& lens = {});
std::vector<DriftingBit> Flakes(const Disturbances& disturbances, const simulation::ScopeView& view,
                                double field_of_view, const simulation::WindowLens& lens = {});
// Flecks of debris in the fluid, by seed and time of the disturbances (picture.h). They are smaller
// than loose tissue, and those near the lens are out of focus.
std::vector<DriftingBit> Flecks(double share, const Disturbances& disturbances,
                                const simulation::ScopeView& view, double field_of_view,
                                const simulation::WindowLens& lens = {});

}  // namespace arthro::app

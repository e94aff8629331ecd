// Bubbles and loose tissue as they stand at a moment: closed functions of seed, time and the view,
// so that any moment can be drawn without those before it. What drifts has its place in the portal
// frame, in a box of fluid that repeats and goes along with the lens, so that it passes by as the
// scope moves; what sticks to the lens has its place in the picture.
#pragma once

#include <vector>

#include <glm/vec2.hpp>

#include "app/view/disturbances/disturbances.h"
#include "app/view/shaders/constants.h"
#include "simulation/scope/arthroscope.h"
#include "simulation/scope/window_lens.h"

namespace arthro::app {

struct DriftingBit {
  glm::dvec2 centre{0.0};  // in the window, in its radii, x right, y up
  double radius = 0;       // in window radii: of the disc that it lies in
  double distance = 0;     // from the lens, m
  double angle = 0;        // of its longer side in the picture, rad
  double shape = 0;        // 0 to 1: which of many shapes; flakes below kFibreShare are fibres
  double opacity = 1;
  double softness = 0;  // of its edge, in its radii: out of focus
};

// How many of them a strength gives: at least one where it is not 0. Not all are in sight.
int BubbleCount(double strength);
int FlakeCount(double strength);

// Those in sight, the farthest first.
std::vector<DriftingBit> Bubbles(const Disturbances& disturbances,
                                 const simulation::ScopeView& view, double field_of_view,
                                 const simulation::WindowLens& lens = {});
std::vector<DriftingBit> Flakes(const Disturbances& disturbances, const simulation::ScopeView& view,
                                double field_of_view, const simulation::WindowLens& lens = {});

}  // namespace arthro::app

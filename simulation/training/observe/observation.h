// Sight of the targets of an exercise in one frame of an attempt, by the exact scope model
// [method.md, Oblique view] and with everything that stands between. Portal frame, m, rad; numbers
// are rounded to 32 bits, then used and written, so that a recorded attempt and a live one give the
// same bits.
#pragma once

#include <array>
#include <limits>

#include <glm/vec3.hpp>

#include "simulation/scene/exercise/exercise.h"

namespace arthro::simulation {

// Sight of one point.
struct PointSight {
  glm::vec3 place{0.0F};  // place in this frame; it moves with its tissue
  // Distance of its image from the centre of the picture; 1 is the rim.
  float centre = std::numeric_limits<float>::infinity();
  float distance = 0;     // m, from the lens
  float incidence = 0;    // rad, between the surface's normal and the line to the lens
  bool is_clear = false;  // in the picture, and nothing hides it
  bool is_gone = false;   // its tissue was cut away
  float taken_share = 0;  // share of its regions' first volume that is removed
  friend bool operator==(const PointSight&, const PointSight&) = default;
};

struct Observation {
  int targets = 0;                              // used of `target`
  std::array<PointSight, kMostTargets> target;  // in the order of the exercise
  bool is_tip_visible = false;  // two of three points at 0, 1, 2 mm behind the tip are clear
  friend bool operator==(const Observation&, const Observation&) = default;
};

}  // namespace arthro::simulation

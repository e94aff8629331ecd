// The instrument as capsules in the lens frame: it shades what is behind it, and it does not count
// in the exposure of the camera. Plain values, no OpenGL.
#pragma once

#include <glm/vec3.hpp>

#include "app/view/shaders/constants.h"

namespace arthro::app {

// Instrument as it shades what is behind it: its rod, and the part that stands away from it, a hook
// or an open jaw. m, in the lens frame (x right, y up, -z along the view).
struct LensRod {
  glm::dvec3 from{0.0}, to{0.0};
  double radius = 0;  // 0: no such part
};
struct LensShade {
  LensRod rod, head;
  // Place of the light fibres: beside the lens, on the side of the scope's mark, where they stay
  // when the camera head turns.
  glm::dvec3 lamp{0.0, kLampAside, 0.0};
};

// Returns whether a ray from the lens meets a capsule, widened by a margin for the highlights
// beside it. `ray` is unit.
bool MeetsRod(const glm::dvec3& ray, const LensRod& rod) noexcept;

}  // namespace arthro::app

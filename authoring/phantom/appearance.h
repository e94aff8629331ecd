// What the phantom's surfaces look like through a scope: tissue colours, mottling, fibres, vessels,
// wetness, light that falls off from the scope and dark recesses. Linear RGB; the light's scale is
// set by exposure.
#pragma once

#include <glm/vec3.hpp>

#include "authoring/phantom/cavity.h"
#include "authoring/phantom/vessels.h"

namespace arthro::authoring {

enum class Difficulty { kEasy, kMedium, kHard };

// How clearly the tissue shows. Harder pictures have fainter texture and vessels, more haze (the
// share of a pixel that is veil rather than tissue, at 50 mm) and less light.
struct Look {
  double texture = 1.0, vessels = 1.0, haze = 0.0, light = 1.0;
};
Look LookOf(Difficulty difficulty);

// One point of a surface as the picture needs it; portal frame.
struct SurfacePoint {
  glm::dvec3 x{0.0}, direction{0.0}, normal{0.0};
  Surface surface = Surface::kCapsule;
  double wall_gap = 0;  // m, along the ray, to the synovium behind
  double shade = 1.0;   // what is left of the light beside a tissue that lies on this surface
  double rim = 0.0;     // on the meniscus: 0 at the free edge, 1 at the outer rim
};

glm::dvec3 Radiance(const Cavity& cavity, const VesselTrees& vessels, const Look& look,
                    const SurfacePoint& point);

// The camera's response: exposes, rolls highlights off, adds no noise. sRGB, 0 to 1.
glm::dvec3 Develop(const glm::dvec3& radiance, double exposure);

}  // namespace arthro::authoring

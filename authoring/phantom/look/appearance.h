// Appearance of the phantom's surfaces through a scope: tissues (tissue_looks.h), light that falls
// off from the scope and dark recesses. Highlights are absent, because they move with the scope and
// the view adds them. Linear RGB; the exposure sets the scale of the light.
#pragma once

#include <algorithm>

#include <glm/vec3.hpp>

#include "authoring/phantom/look/vessels.h"
#include "authoring/phantom/shape/cavity.h"

namespace arthro::authoring {

enum class Difficulty { kEasy, kMedium, kHard };

// Visibility of the tissue. Harder pictures have fainter texture and vessels, more haze (share of
// scattered light in a pixel at 50 mm) and less light.
struct Look {
  double texture = 1.0, vessels = 1.0, haze = 0.0, light = 1.0;
};
Look LookOf(Difficulty difficulty);

// Colour between two; beyond 0 and 1, the nearer one.
inline glm::dvec3 Mix(const glm::dvec3& a, const glm::dvec3& b, double t) {
  return a + (b - a) * std::clamp(t, 0.0, 1.0);
}

// Properties of one surface point that the picture needs; portal frame.
struct SurfacePoint {
  glm::dvec3 x{0.0}, direction{0.0}, normal{0.0};
  Surface surface = Surface::kCapsule;
  double wall_gap = 0;  // m, distance along the ray to the synovium behind
  double shade = 1.0;   // share of the light that a tissue on this surface lets through
  double rim = 0.0;     // on the meniscus: 0 at the free edge, 1 at the outer rim
};

glm::dvec3 Radiance(const Cavity& cavity, const VesselTrees& vessels, const Look& look,
                    const SurfacePoint& point);

// Response of the camera: exposes, compresses highlights, adds no noise. sRGB, 0 to 1.
glm::dvec3 Develop(const glm::dvec3& radiance, double exposure);

}  // namespace arthro::authoring

// Colour and fine structure of each tissue of the phantom: mottling, fibres, capillaries, villi and
// lobules down to a quarter of a millimetre, the finest that a panorama of 10 px per degree holds.
// Linear RGB; portal frame, m.
#pragma once

#include <glm/vec3.hpp>

#include "authoring/phantom/look/appearance.h"

namespace arthro::authoring {

struct TissueLook {
  glm::dvec3 colour{0.5};
  glm::dvec3 slope{0.0};  // gradient of the height of the fine structure, dimensionless
  double depth = 0.2;     // share by which light wraps round inside the tissue
};

TissueLook LookAt(const Cavity& cavity, const VesselTrees& vessels, const Look& look,
                  const SurfacePoint& point);

}  // namespace arthro::authoring

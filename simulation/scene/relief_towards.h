// Relief of a backdrop in one direction from the portal, from the nearest pixel of its depth map.
#pragma once

#include <glm/vec3.hpp>

#include "simulation/scene/image.h"
#include "simulation/scene/scene.h"

namespace arthro {

// In m over the sphere: 0 without a depth map, NaN where nothing was imaged.
double ReliefTowards(const glm::dvec3& direction, const DepthMap& depth, const Backdrop& backdrop);

}  // namespace arthro

// Distance from the scope's portal to the relief of a backdrop [method.md, Backdrop]. m, portal
// frame.
#pragma once

#include <glm/vec3.hpp>

#include "simulation/scene/image.h"
#include "simulation/scene/scene.h"

namespace arthro {

// From the nearest pixel of the depth map in a unit direction: D − h. Without a depth map: D. NaN
// where nothing was imaged.
double ReliefRange(const glm::dvec3& direction, const DepthMap& depth,
                   const Backdrop& backdrop) noexcept;

}  // namespace arthro

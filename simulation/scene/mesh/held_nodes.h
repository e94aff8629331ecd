// Held nodes of a tissue's mesh: those inside any of its balls (scene.h, Tissue::fixed or
// Tissue::probed). Mesh's own frame, m.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "simulation/scene/scene.h"

namespace arthro {

// 1 or 0 a node; the boundary of a ball belongs to it.
std::vector<std::uint8_t> HeldNodes(std::span<const glm::dvec3> nodes, std::span<const Ball> balls);

}  // namespace arthro

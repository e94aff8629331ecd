// Where in an element a rest position is, and with which weights its nodes carry it.
#pragma once

#include <array>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "simulation/scene/tet_mesh.h"

namespace arthro::simulation {

struct ElementPoint {
  glm::dvec4 barycentric{0.25};     // of the place itself or, outside, about where it is nearest
  std::array<double, 10> weight{};  // outside: going on linearly from there
};

// By Newton's method on the isoparametric map. The weights give back `rest`, and every affine
// motion of it, exactly.
ElementPoint PointIn(const TetMesh& mesh, int element, const glm::dvec3& rest);

}  // namespace arthro::simulation

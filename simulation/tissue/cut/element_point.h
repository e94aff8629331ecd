// Position of a rest point in an element, and the weights of the element's nodes there.
#pragma once

#include <array>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "simulation/scene/tet_mesh.h"

namespace arthro::simulation {

struct ElementPoint {
  glm::dvec4 barycentric{0.25};  // the point, or if outside about the nearest point of the element
  std::array<double, 10> weight{};  // outside: linear extrapolation from that nearest point
};

// Inverts the isoparametric map by Newton's method. The weights reproduce `rest`, and every affine
// motion of it, exactly.
ElementPoint PointIn(const TetMesh& mesh, int element, const glm::dvec3& rest);

}  // namespace arthro::simulation

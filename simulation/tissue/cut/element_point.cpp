#include "simulation/tissue/cut/element_point.h"

#include <algorithm>
#include <cstddef>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "simulation/tissue/fem/tet_shape.h"

namespace arthro::simulation {
namespace {

// Clamps to the tetrahedron: negative coordinates become zero, the rest is scaled to a sum of 1.
glm::dvec4 Clamped(const glm::dvec4& l) {
  glm::dvec4 in;
  double sum = 0.0;
  for (int i = 0; i < 4; ++i) sum += in[i] = std::max(0.0, l[i]);
  return sum > 0.0 ? in / sum : glm::dvec4(0.25);
}

}  // namespace

ElementPoint PointIn(const TetMesh& mesh, int element, const glm::dvec3& rest) {
  const auto n = static_cast<std::size_t>(mesh.NodesPerElement());
  const auto node = [&](std::size_t i) {
    return mesh.rest_positions[static_cast<std::size_t>(
        mesh.elements[static_cast<std::size_t>(element) * n + i])];
  };
  ElementPoint point;
  point.barycentric = Clamped(BarycentricIn({node(0), node(1), node(2), node(3)}, rest));
  TetShape shape;
  glm::dvec3 step(0.0);
  constexpr int kSteps = 8;  // converges quadratically: 0.1, 1e-2, 1e-4, 1e-8, 1e-16;
                             // a straight element needs one step
  for (int i = 0; i < kSteps; ++i) {
    shape = ShapeAt(mesh.order, point.barycentric);
    glm::dvec3 x(0.0);
    glm::dmat3 jacobian(0.0);
    for (std::size_t a = 0; a < n; ++a) {
      x += shape.value[a] * node(a);
      for (int c = 0; c < 3; ++c) jacobian[c] += node(a) * shape.slope[a][c];
    }
    step = glm::inverse(jacobian) * (rest - x);
    if (i + 1 == kSteps || glm::dot(step, step) < 1e-30) break;
    const glm::dvec4 next =
        point.barycentric + glm::dvec4(-step.x - step.y - step.z, step.x, step.y, step.z);
    const glm::dvec4 held = Clamped(next), moved = held - point.barycentric;
    if (glm::dot(moved, moved) < 1e-30) break;  // outside: the nearest point is reached
    point.barycentric = held;
  }
  for (std::size_t a = 0; a < n; ++a)
    point.weight[a] = shape.value[a] + glm::dot(shape.slope[a], step);
  return point;
}

}  // namespace arthro::simulation

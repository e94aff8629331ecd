#include "simulation/tissue/fem/tet_shape.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace arthro::simulation {
namespace {

constexpr std::array<std::array<int, 2>, 6> kEdges{
    {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};

// Returns ∂L_i/∂(L1, L2, L3).
glm::dvec3 SlopeOf(int i) {
  if (i == 0) return {-1, -1, -1};
  glm::dvec3 slope(0.0);
  slope[i - 1] = 1;
  return slope;
}

std::vector<TetShape> MakeQuadrature(int order) {
  if (order == 1) return {ShapeAt(1, glm::dvec4(0.25))};
  // Degree 2: one coordinate is a, the other three are b.
  const double b = (5.0 - std::sqrt(5.0)) / 20.0, a = 1.0 - 3.0 * b;
  std::vector<TetShape> points;
  for (int i = 0; i < 4; ++i) {
    glm::dvec4 at(b);
    at[i] = a;
    points.push_back(ShapeAt(2, at));
    points.back().weight = 0.25;
  }
  return points;
}

// Clamps to the tetrahedron: negative coordinates become zero, the rest is scaled to a sum of 1.
glm::dvec4 Clamped(const glm::dvec4& l) {
  glm::dvec4 in;
  double sum = 0.0;
  for (int i = 0; i < 4; ++i) sum += in[i] = std::max(0.0, l[i]);
  return sum > 0.0 ? in / sum : glm::dvec4(0.25);
}

}  // namespace

TetShape ShapeAt(int order, const glm::dvec4& l) {
  TetShape shape;
  shape.weight = 1;
  shape.slope.fill(glm::dvec3(0.0));
  for (int i = 0; i < 4; ++i) {
    shape.value[i] = order == 1 ? l[i] : l[i] * (2 * l[i] - 1);
    shape.slope[i] = (order == 1 ? 1.0 : 4 * l[i] - 1) * SlopeOf(i);
  }
  if (order == 1) return shape;
  for (int e = 0; e < 6; ++e) {
    const auto [i, j] = kEdges[e];
    shape.value[4 + e] = 4 * l[i] * l[j];
    shape.slope[4 + e] = 4 * l[i] * SlopeOf(j) + 4 * l[j] * SlopeOf(i);
  }
  return shape;
}

glm::dvec4 BarycentricIn(const std::array<glm::dvec3, 4>& corner, const glm::dvec3& x) noexcept {
  const glm::dvec3 a = corner[1] - corner[0], b = corner[2] - corner[0], c = corner[3] - corner[0],
                   p = x - corner[0];
  const double det = glm::dot(glm::cross(a, b), c);
  if (det == 0.0) return glm::dvec4(-1.0);
  const glm::dvec3 l(glm::dot(glm::cross(p, b), c) / det, glm::dot(glm::cross(a, p), c) / det,
                     glm::dot(glm::cross(a, b), p) / det);
  return {1.0 - l.x - l.y - l.z, l};
}

const std::vector<TetShape>& QuadraturePoints(int order) {
  static const std::vector<TetShape> linear = MakeQuadrature(1), quadratic = MakeQuadrature(2);
  return order == 2 ? quadratic : linear;
}

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

#include "simulation/tissue/fem/tet_shape.h"

#include <cmath>

#include <glm/geometric.hpp>

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

}  // namespace arthro::simulation

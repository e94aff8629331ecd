// Shape functions of T4 and T10 elements (VTK's node order) and their faces. Quadrature has one
// point for T4 and four for T10 [Zienkiewicz & Taylor 2000]. Points of the reference tetrahedron
// are given by barycentric coordinates.
#pragma once

#include <array>
#include <vector>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "simulation/scene/mesh/tet_mesh.h"

namespace arthro::simulation {

struct TetShape {
  double weight = 0;                 // fraction of the reference tetrahedron's volume
  std::array<double, 10> value{};    // N_a
  std::array<glm::dvec3, 10> slope;  // ∂N_a/∂(L1, L2, L3), L0 = 1 − L1 − L2 − L3
};

TetShape ShapeAt(int order, const glm::dvec4& barycentric);

// Returns the barycentric coordinates of x in the straight tetrahedron with these corners, of
// either handedness. They sum to 1 and are negative beyond a face. A flat tetrahedron has no inside
// and gives −1 four times.
glm::dvec4 BarycentricIn(const std::array<glm::dvec3, 4>& corner, const glm::dvec3& x) noexcept;

// Returns the quadrature points of an element of this order.
const std::vector<TetShape>& QuadraturePoints(int order);

// Corners of the four outward-facing faces, each followed by the midpoints of its edges 01, 12, 20.
inline constexpr std::array<std::array<int, 6>, 4> kTetFaces{
    {{0, 2, 1, 6, 5, 4}, {0, 1, 3, 4, 8, 7}, {1, 2, 3, 5, 9, 8}, {2, 0, 3, 6, 7, 9}}};

// Position of a rest point in an element, and the weights of the element's nodes there.
struct ElementPoint {
  glm::dvec4 barycentric{0.25};  // the point, or if outside about the nearest point of the element
  std::array<double, 10> weight{};  // outside: linear extrapolation from that nearest point
};

// Inverts the isoparametric map by Newton's method. The weights reproduce `rest`, and every affine
// motion of it, exactly.
ElementPoint PointIn(const TetMesh& mesh, int element, const glm::dvec3& rest);

}  // namespace arthro::simulation

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <glm/geometric.hpp>

#include "simulation/tissue/fem/fem_model.h"
#include "simulation/tissue/fem/tet_shape.h"

namespace arthro::simulation {
namespace {

using Face = std::array<int, 6>;  // corners, then the midpoints of edges 01, 12, 20 (order 2)

struct FacePoint {
  double weight;
  std::array<double, 3> l;
};

// Three interior points, degree 2: exact for a uniform traction on a straight face. The reference
// cases use the same rule on curved faces.
constexpr std::array<FacePoint, 3> kFaceQuadrature{{{1.0 / 3, {2.0 / 3, 1.0 / 6, 1.0 / 6}},
                                                    {1.0 / 3, {1.0 / 6, 2.0 / 3, 1.0 / 6}},
                                                    {1.0 / 3, {1.0 / 6, 1.0 / 6, 2.0 / 3}}}};

// Returns the faces that belong to one element only, in element order.
std::vector<Face> BoundaryFaces(const TetMesh& mesh) {
  struct Entry {
    std::array<int, 3> sorted;
    Face face;
    std::size_t index;
  };
  std::vector<Entry> entries;
  const int n = mesh.NodesPerElement();
  for (int element = 0; element < mesh.ElementCount(); ++element)
    for (const auto& local : kTetFaces) {
      Face face{};
      for (int i = 0; i < (mesh.order == 2 ? 6 : 3); ++i)
        face[i] = mesh.elements[static_cast<std::size_t>(element) * n + local[i]];
      std::array<int, 3> sorted{face[0], face[1], face[2]};
      std::sort(sorted.begin(), sorted.end());
      entries.push_back({sorted, face, entries.size()});
    }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return std::pair(a.sorted, a.index) < std::pair(b.sorted, b.index);
  });
  std::vector<Entry> single;
  for (std::size_t i = 0; i < entries.size();) {
    std::size_t end = i + 1;
    while (end < entries.size() && entries[end].sorted == entries[i].sorted) ++end;
    if (end == i + 1) single.push_back(entries[i]);
    i = end;
  }
  std::sort(single.begin(), single.end(),
            [](const Entry& a, const Entry& b) { return a.index < b.index; });
  std::vector<Face> faces;
  faces.reserve(single.size());
  for (const Entry& entry : single) faces.push_back(entry.face);
  return faces;
}

// Returns ∫ N_a dA over one face.
std::array<double, 6> FaceShares(const TetMesh& mesh, const Face& face) {
  const auto at = [&](int i) -> const glm::dvec3& { return mesh.rest_positions[face[i]]; };
  std::array<double, 6> share{};
  if (mesh.order == 1) {
    const double area = 0.5 * glm::length(glm::cross(at(1) - at(0), at(2) - at(0)));
    for (int a = 0; a < 3; ++a) share[a] = area / 3;
    return share;
  }
  for (const auto& [weight, l] : kFaceQuadrature) {
    // Shape functions and their derivatives by l1 and l2, with l0 = 1 − l1 − l2.
    const std::array<double, 6> value{l[0] * (2 * l[0] - 1), l[1] * (2 * l[1] - 1),
                                      l[2] * (2 * l[2] - 1), 4 * l[0] * l[1],
                                      4 * l[1] * l[2],       4 * l[2] * l[0]};
    const std::array<double, 6> by_l1{1 - 4 * l[0],      4 * l[1] - 1, 0,
                                      4 * (l[0] - l[1]), 4 * l[2],     -4 * l[2]};
    const std::array<double, 6> by_l2{1 - 4 * l[0], 0,        4 * l[2] - 1,
                                      -4 * l[1],    4 * l[1], 4 * (l[0] - l[2])};
    glm::dvec3 u(0.0), v(0.0);
    for (int a = 0; a < 6; ++a) {
      u += by_l1[a] * at(a);
      v += by_l2[a] * at(a);
    }
    const double area = 0.5 * weight * glm::length(glm::cross(u, v));
    for (int a = 0; a < 6; ++a) share[a] += area * value[a];
  }
  return share;
}

}  // namespace

double AddSurfaceLoad(const TetMesh& mesh, std::span<const unsigned char> set,
                      const glm::dvec3& total, std::span<glm::dvec3> force) {
  std::vector<double> share(mesh.rest_positions.size(), 0.0);
  double area = 0;
  for (const Face& face : BoundaryFaces(mesh)) {
    if (!set[face[0]] || !set[face[1]] || !set[face[2]]) continue;
    const std::array<double, 6> part = FaceShares(mesh, face);
    for (int a = 0; a < (mesh.order == 2 ? 6 : 3); ++a) {
      share[face[a]] += part[a];
      area += part[a];
    }
  }
  if (area > 0)
    for (std::size_t i = 0; i < share.size(); ++i) force[i] += share[i] / area * total;
  return area;
}

}  // namespace arthro::simulation

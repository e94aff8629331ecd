#include "authoring/tissue/tetrahedra/tet_quality.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>

namespace arthro::authoring {
namespace {

constexpr std::array<std::array<int, 2>, 6> kMiddleEdges = {
    {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};  // VTK's order of mid nodes
constexpr std::array<std::array<int, 3>, 4> kFaceCorners = {
    {{1, 2, 3}, {0, 2, 3}, {0, 1, 3}, {0, 1, 2}}};

int EdgeBetween(int a, int b) {
  for (int i = 0; i < 6; ++i)
    if ((kMiddleEdges[i][0] == a && kMiddleEdges[i][1] == b) ||
        (kMiddleEdges[i][0] == b && kMiddleEdges[i][1] == a))
      return i;
  return -1;
}

// Returns det(dx/dξ) of a quadratic element at barycentric coordinates; ξ is the last three of
// them.
double JacobianAt(const std::array<glm::dvec3, 10>& x, const std::array<double, 4>& l) {
  // Corner k: N = l(2l − 1), middle of ab: N = 4 la lb; derivatives by each l.
  std::array<glm::dvec3, 4> by{};
  for (int k = 0; k < 4; ++k) by[k] = (4.0 * l[k] - 1.0) * x[k];
  for (int m = 0; m < 6; ++m) {
    const auto& [a, b] = kMiddleEdges[m];
    by[a] += 4.0 * l[b] * x[4 + m];
    by[b] += 4.0 * l[a] * x[4 + m];
  }
  const glm::dvec3 u = by[1] - by[0], v = by[2] - by[0], w = by[3] - by[0];
  return glm::dot(glm::cross(u, v), w);
}

// Corners, middles and the four quadrature points (a = 0.585…, b = 0.138…).
std::array<std::array<double, 4>, 14> SamplePoints() {
  std::array<std::array<double, 4>, 14> points{};
  const double b = (5.0 - std::sqrt(5.0)) / 20.0, a = 1.0 - 3.0 * b;
  for (int k = 0; k < 4; ++k) {
    points[k][k] = 1.0;
    points[10 + k] = {b, b, b, b};
    points[10 + k][k] = a;
  }
  for (int m = 0; m < 6; ++m)
    points[4 + m][kMiddleEdges[m][0]] = points[4 + m][kMiddleEdges[m][1]] = 0.5;
  return points;
}

std::array<glm::dvec3, 10> NodesOf(const TetMesh& mesh, int element) {
  std::array<glm::dvec3, 10> x;
  for (int k = 0; k < 10; ++k)
    x[k] = mesh.rest_positions[mesh.elements[static_cast<std::size_t>(element) * 10 + k]];
  return x;
}

}  // namespace

double JacobianShare(const TetMesh& mesh, int element) {
  if (mesh.order != 2) return 1.0;
  static const auto points = SamplePoints();
  const std::array<glm::dvec3, 10> x = NodesOf(mesh, element);
  double least = std::numeric_limits<double>::infinity();
  for (const auto& point : points) least = std::min(least, JacobianAt(x, point));
  return least / glm::dot(glm::cross(x[1] - x[0], x[2] - x[0]), x[3] - x[0]);
}

TetQuality MeasureTets(const TetMesh& mesh) {
  TetQuality quality;
  const int count = mesh.ElementCount(), nodes = mesh.NodesPerElement();
  if (count == 0) return quality;
  quality.min_dihedral = std::numbers::pi;
  quality.worst_relative_volume = std::numeric_limits<double>::infinity();
  std::vector<double> edges;
  edges.reserve(6 * static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const int* node = &mesh.elements[static_cast<std::size_t>(i) * nodes];
    std::array<glm::dvec3, 4> x;
    for (int k = 0; k < 4; ++k) x[k] = mesh.rest_positions[node[k]];
    const glm::dvec3 u = x[1] - x[0], v = x[2] - x[0], w = x[3] - x[0];
    const double six_volumes = glm::dot(glm::cross(u, v), w);
    quality.volume += six_volumes / 6.0;
    if (mesh.order == 2) {
      quality.worst_jacobian = std::min(quality.worst_jacobian, JacobianShare(mesh, i));
      // The mean over the four quadrature points is exact for a determinant of second order.
      static const auto points = SamplePoints();
      const auto all = NodesOf(mesh, i);
      for (int p = 10; p < 14; ++p) quality.curved_volume += JacobianAt(all, points[p]) / 24.0;
    } else {
      quality.curved_volume += six_volumes / 6.0;
    }
    quality.inverted += !(six_volumes > 0);
    double shortest = std::numeric_limits<double>::infinity(), longest = 0;
    for (const auto& [a, b] : kMiddleEdges) {
      const double length = glm::distance(x[a], x[b]);
      edges.push_back(length);
      shortest = std::min(shortest, length);
      longest = std::max(longest, length);
    }
    quality.worst_relative_volume =
        std::min(quality.worst_relative_volume, six_volumes / 6.0 / (longest * longest * longest));
    const glm::dvec3 centre = glm::dot(u, u) * glm::cross(v, w) +
                              glm::dot(v, v) * glm::cross(w, u) + glm::dot(w, w) * glm::cross(u, v);
    quality.worst_radius_edge = std::max(
        quality.worst_radius_edge, glm::length(centre) / (2.0 * std::abs(six_volumes)) / shortest);
    // The angle at edge ab is that between its two faces, seen along the edge.
    for (const auto& [a, b] : kMiddleEdges) {
      int c = 0;
      while (c == a || c == b) ++c;
      const int d = 6 - a - b - c;
      const glm::dvec3 along = glm::normalize(x[b] - x[a]);
      const glm::dvec3 p = x[c] - x[a], q = x[d] - x[a];
      const glm::dvec3 to_c = p - along * glm::dot(along, p), to_d = q - along * glm::dot(along, q);
      const double angle = std::atan2(glm::length(glm::cross(to_c, to_d)), glm::dot(to_c, to_d));
      quality.min_dihedral = std::min(quality.min_dihedral, angle);
      quality.max_dihedral = std::max(quality.max_dihedral, angle);
    }
  }
  const auto middle = edges.begin() + static_cast<std::ptrdiff_t>(edges.size() / 2);
  std::nth_element(edges.begin(), middle, edges.end());
  quality.median_edge = *middle;
  quality.longest_edge = *std::max_element(edges.begin(), edges.end());
  return quality;
}

std::vector<std::uint8_t> SurfaceNodes(const TetMesh& mesh) {
  struct Face {
    std::array<int, 3> corners;  // ascending
    int element, face;
  };
  const int nodes = mesh.NodesPerElement();
  std::vector<Face> faces;
  faces.reserve(4 * static_cast<std::size_t>(mesh.ElementCount()));
  for (int i = 0; i < mesh.ElementCount(); ++i)
    for (int k = 0; k < 4; ++k) {
      Face face{{}, i, k};
      for (int c = 0; c < 3; ++c)
        face.corners[c] = mesh.elements[static_cast<std::size_t>(i) * nodes + kFaceCorners[k][c]];
      std::sort(face.corners.begin(), face.corners.end());
      faces.push_back(face);
    }
  std::sort(faces.begin(), faces.end(),
            [](const Face& f, const Face& g) { return f.corners < g.corners; });
  std::vector<std::uint8_t> on_surface(mesh.rest_positions.size(), 0);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const bool shared = (i > 0 && faces[i].corners == faces[i - 1].corners) ||
                        (i + 1 < faces.size() && faces[i].corners == faces[i + 1].corners);
    if (shared) continue;
    const int* node = &mesh.elements[static_cast<std::size_t>(faces[i].element) * nodes];
    const auto& face = kFaceCorners[faces[i].face];
    for (int c = 0; c < 3; ++c) {
      on_surface[node[face[c]]] = 1;
      if (mesh.order == 2) on_surface[node[4 + EdgeBetween(face[c], face[(c + 1) % 3])]] = 1;
    }
  }
  return on_surface;
}

}  // namespace arthro::authoring

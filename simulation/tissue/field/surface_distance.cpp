#include "simulation/tissue/field/surface_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "simulation/core/error.h"
#include "simulation/core/finite.h"
#include "simulation/core/geometry/triangle.h"

namespace arthro::simulation {
namespace {

constexpr double kExactBand = 2.0;  // spacings

std::vector<TriangleCorners> CheckedTriangles(const SurfaceMesh& surface) {
  if (surface.triangles.empty())
    throw Error(Code::kBadMesh, "the surface has no triangles; a solid needs a closed one");
  for (const glm::dvec3& x : surface.vertices)
    if (!IsFinite(x))
      throw Error(Code::kBadMesh, "the surface has a vertex that is not finite; repair it first");
  // A closed surface uses every edge equally often in both directions.
  std::vector<std::array<int, 3>> edges;
  std::vector<TriangleCorners> triangles;
  edges.reserve(3 * surface.triangles.size());
  triangles.reserve(surface.triangles.size());
  for (const auto& corners : surface.triangles) {
    TriangleCorners triangle;
    for (std::size_t i = 0; i < 3; ++i) {
      const int a = corners[i], b = corners[(i + 1) % 3];
      if (a < 0 || a >= static_cast<int>(surface.vertices.size()))
        throw Error(Code::kBadMesh, "a triangle names vertex " + std::to_string(a) +
                                        ", which the surface does not have");
      triangle[i] = surface.vertices[static_cast<std::size_t>(a)];
      edges.push_back({std::min(a, b), std::max(a, b), a < b ? 1 : -1});
    }
    triangles.push_back(triangle);
  }
  std::sort(edges.begin(), edges.end());
  int open = 0;
  for (std::size_t i = 0, end = 0; i < edges.size(); i = end) {
    int balance = 0;
    for (end = i;
         end < edges.size() && edges[end][0] == edges[i][0] && edges[end][1] == edges[i][1]; ++end)
      balance += edges[end][2];
    open += edges[i][0] != edges[i][1] && balance != 0;
  }
  if (open > 0)
    throw Error(Code::kBadMesh, "the surface is not closed (" + std::to_string(open) +
                                    " open edges); close it before it is made a solid");
  return triangles;
}

// Returns the side of the line from p to q on which the origin lies. An origin on the line gets the
// answer of a point beside it, always the same for that line (simulation of simplicity, as in
// Bridson's SDFGen).
int Side(double px, double py, double qx, double qy, double& twice_area) noexcept {
  twice_area = py * qx - px * qy;
  if (twice_area > 0) return 1;
  if (twice_area < 0) return -1;
  if (qy > py) return 1;
  if (qy < py) return -1;
  if (px > qx) return 1;
  if (px < qx) return -1;
  return 0;
}

// Adds one vote to every node that the surface winds around, as seen along `axis`.
void Vote(const std::vector<TriangleCorners>& triangles, const FieldGrid& grid, int axis,
          std::vector<std::uint8_t>& votes) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const auto count = [&](int a) { return grid.count[static_cast<std::size_t>(a)]; };
  // crossing[(line, n)]: increase of the winding number between nodes n − 1 and n of the line.
  std::vector<std::int16_t> crossing(grid.NodeCount(), 0);
  const auto index = [&](int iu, int iv, int n) {
    std::array<int, 3> at{};
    at[static_cast<std::size_t>(axis)] = n;
    at[static_cast<std::size_t>(u)] = iu;
    at[static_cast<std::size_t>(v)] = iv;
    return grid.Index(at[0], at[1], at[2]);
  };
  for (const TriangleCorners& triangle : triangles) {
    std::array<glm::dvec3, 3> x;
    for (std::size_t i = 0; i < 3; ++i) x[i] = (triangle[i] - grid.origin) / grid.spacing;
    const auto first = [&](int a) {
      return std::max(0, static_cast<int>(std::ceil(std::min({x[0][a], x[1][a], x[2][a]}))));
    };
    const auto last = [&](int a) {
      return std::min(count(a) - 1,
                      static_cast<int>(std::floor(std::max({x[0][a], x[1][a], x[2][a]}))));
    };
    for (int iv = first(v); iv <= last(v); ++iv)
      for (int iu = first(u); iu <= last(u); ++iu) {
        std::array<double, 3> area;
        int side = 0;
        bool is_in = true;
        for (std::size_t i = 0; i < 3 && is_in; ++i) {
          const glm::dvec3 &p = x[(i + 1) % 3], &q = x[(i + 2) % 3];
          const int s = Side(p[u] - iu, p[v] - iv, q[u] - iu, q[v] - iv, area[i]);
          if (i == 0) side = s;
          is_in = s != 0 && s == side;
        }
        const double whole = is_in ? area[0] + area[1] + area[2] : 0.0;
        if (whole == 0.0) continue;
        const double height =
            (area[0] * x[0][axis] + area[1] * x[1][axis] + area[2] * x[2][axis]) / whole;
        const int n = std::clamp(static_cast<int>(std::ceil(height)), 0, count(axis) - 1);
        // A counter-clockwise triangle appears clockwise from below, where the line enters it.
        crossing[index(iu, iv, n)] =
            static_cast<std::int16_t>(crossing[index(iu, iv, n)] + (side > 0 ? 1 : -1));
      }
  }
  for (int iv = 0; iv < count(v); ++iv)
    for (int iu = 0; iu < count(u); ++iu) {
      int winding = 0;
      for (int n = 0; n < count(axis); ++n) {
        const std::size_t node = index(iu, iv, n);
        winding += crossing[node];
        votes[node] = static_cast<std::uint8_t>(votes[node] + (winding > 0));
      }
    }
}

}  // namespace

std::vector<float> SignedDistances(const SurfaceMesh& surface, const FieldGrid& grid, double band) {
  const std::vector<TriangleCorners> triangles = CheckedTriangles(surface);
  const auto& n = grid.count;
  // Near the surface, compares each triangle with the nodes around it: exact.
  std::vector<double> distance2(grid.NodeCount(), std::numeric_limits<double>::max());
  std::vector<int> nearest(grid.NodeCount(), -1);
  const auto reach = [&](std::size_t node, int triangle, const glm::dvec3& x) {
    const double d = Distance2(triangles[static_cast<std::size_t>(triangle)], x);
    if (d < distance2[node]) distance2[node] = d, nearest[node] = triangle;
  };
  const double exact = kExactBand * grid.spacing;
  for (int t = 0; t < static_cast<int>(triangles.size()); ++t) {
    const auto& corner = triangles[static_cast<std::size_t>(t)];
    const glm::dvec3 across = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
    const double area = glm::length(across);
    if (!(area > 0.0)) continue;  // its neighbours cover its sides
    const glm::dvec3 normal = across / area;
    const glm::dvec3 low = glm::min(glm::min(corner[0], corner[1]), corner[2]) - exact;
    const glm::dvec3 high = glm::max(glm::max(corner[0], corner[1]), corner[2]) + exact;
    std::array<int, 3> first, last;
    for (std::size_t a = 0; a < 3; ++a) {
      const int axis = static_cast<int>(a);
      first[a] =
          std::max(0, static_cast<int>(std::ceil((low[axis] - grid.origin[axis]) / grid.spacing)));
      last[a] = std::min(
          n[a] - 1, static_cast<int>(std::floor((high[axis] - grid.origin[axis]) / grid.spacing)));
    }
    for (int k = first[2]; k <= last[2]; ++k)
      for (int j = first[1]; j <= last[1]; ++j)
        for (int i = first[0]; i <= last[0]; ++i) {
          const glm::dvec3 x = grid.Place(i, j, k);
          const std::size_t node = grid.Index(i, j, k);
          const double height = glm::dot(normal, x - corner[0]);
          if (height * height < std::min(distance2[node], exact * exact)) reach(node, t, x);
        }
  }
  // Further off, eight sweeps, each from one corner of the grid, propagate the nearest triangle.
  for (int sweep = 0; sweep < 8; ++sweep) {
    std::array<int, 3> step;
    for (std::size_t a = 0; a < 3; ++a) step[a] = (sweep >> a & 1) ? -1 : 1;
    const auto at = [&](std::size_t a, int s) { return step[a] > 0 ? s : n[a] - 1 - s; };
    for (int sk = 0; sk < n[2]; ++sk)
      for (int sj = 0; sj < n[1]; ++sj)
        for (int si = 0; si < n[0]; ++si) {
          const int i = at(0, si), j = at(1, sj), k = at(2, sk);
          const std::size_t node = grid.Index(i, j, k);
          if (distance2[node] <= exact * exact) continue;
          const std::array<int, 3> from = {si > 0 ? nearest[grid.Index(i - step[0], j, k)] : -1,
                                           sj > 0 ? nearest[grid.Index(i, j - step[1], k)] : -1,
                                           sk > 0 ? nearest[grid.Index(i, j, k - step[2])] : -1};
          for (std::size_t a = 0; a < 3; ++a)
            if (from[a] >= 0 && from[a] != nearest[node] && (a == 0 || from[a] != from[a - 1]))
              reach(node, from[a], grid.Place(i, j, k));
        }
  }
  std::vector<std::uint8_t> votes(grid.NodeCount(), 0);
  for (int axis = 0; axis < 3; ++axis) Vote(triangles, grid, axis, votes);
  std::vector<float> distance(grid.NodeCount());
  for (std::size_t node = 0; node < distance.size(); ++node) {
    const double d = std::min(std::sqrt(distance2[node]), band);
    distance[node] = static_cast<float>(votes[node] >= 2 ? -d : d);
  }
  return distance;
}

}  // namespace arthro::simulation

#include "simulation/scene/formats/meshes/polygon_soup.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <unordered_map>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "simulation/core/error.h"

namespace arthro {
namespace {

struct PointHash {
  std::size_t operator()(const glm::dvec3& p) const {
    std::uint64_t hash = 0;
    for (int axis = 0; axis < 3; ++axis) {
      // + 0.0 makes -0 and 0, which compare equal, the same bits.
      hash ^= std::bit_cast<std::uint64_t>(p[axis] + 0.0) + 0x9e3779b97f4a7c15u + (hash << 6) +
              (hash >> 2);
      hash *= 0xff51afd7ed558ccdu;
    }
    return static_cast<std::size_t>(hash ^ (hash >> 32));
  }
};

// Twice the area vector of a polygon (Newell): its direction is the polygon's mean normal.
glm::dvec3 AreaVector(const std::vector<glm::dvec3>& points, std::span<const int> polygon) {
  glm::dvec3 sum(0.0);
  const glm::dvec3 origin = points[polygon[0]];
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    sum += glm::cross(points[polygon[i]] - origin, points[polygon[i + 1]] - origin);
  return sum;
}

bool IsInside(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
              const glm::dvec3& normal) {
  return glm::dot(glm::cross(b - a, p - a), normal) >= 0 &&
         glm::dot(glm::cross(c - b, p - b), normal) >= 0 &&
         glm::dot(glm::cross(a - c, p - c), normal) >= 0;
}

// Cuts ears off until a triangle is left; a polygon that is too crooked to have an ear is cut at
// its first corner, so that the number of triangles never depends on its shape.
void Triangulate(const std::vector<glm::dvec3>& points, std::vector<int> polygon,
                 std::vector<std::array<int, 3>>& triangles) {
  const glm::dvec3 normal = AreaVector(points, polygon);
  while (polygon.size() > 3) {
    const int n = static_cast<int>(polygon.size());
    int ear = 0;
    double best = -1.0;
    for (int i = 0; i < n; ++i) {
      const int before = polygon[(i + n - 1) % n], tip = polygon[i], after = polygon[(i + 1) % n];
      const glm::dvec3 &a = points[before], &b = points[tip], &c = points[after];
      if (glm::dot(glm::cross(b - a, c - b), normal) <= 0) continue;
      const bool holds_another = std::any_of(polygon.begin(), polygon.end(), [&](int other) {
        return other != before && other != tip && other != after &&
               IsInside(points[other], a, b, c, normal);
      });
      // Takes the ear with the shortest cut, which makes fewer slivers.
      const double shortness = 1.0 / (glm::length(c - a) + 1e-300);
      if (!holds_another && shortness > best) {
        best = shortness;
        ear = i;
      }
    }
    triangles.push_back({polygon[(ear + n - 1) % n], polygon[ear], polygon[(ear + 1) % n]});
    polygon.erase(polygon.begin() + ear);
  }
  triangles.push_back({polygon[0], polygon[1], polygon[2]});
}

void Check(const PolygonSoup& soup, const std::filesystem::path& file) {
  for (std::size_t i = 0; i < soup.points.size(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      if (!std::isfinite(soup.points[i][axis]))
        throw Error(Code::kBadMesh,
                    fmt::format("vertex {} has a coordinate that is not a finite number; export "
                                "the surface again",
                                i),
                    file);
  for (const int corner : soup.corners)
    if (corner < 0 || corner >= static_cast<int>(soup.points.size()))
      throw Error(Code::kBadMesh,
                  fmt::format("a polygon names vertex {} but there are only {} (counted from 0); "
                              "the file is damaged or cut off",
                              corner, soup.points.size()),
                  file);
  if (soup.polygon_ends.empty())
    throw Error(Code::kBadMesh,
                "there is no triangle in this file; export the surface as triangles", file);
}

}  // namespace

SurfaceMesh SurfaceFromPolygons(const PolygonSoup& soup, double metres_per_unit,
                                const std::filesystem::path& file, SurfaceReadReport* report) {
  Check(soup, file);
  SurfaceReadReport changed;

  // Weld: a point's index is that of the first point at its place.
  std::unordered_map<glm::dvec3, int, PointHash> first_at;
  first_at.reserve(soup.points.size());
  std::vector<int> welded(soup.points.size());
  for (std::size_t i = 0; i < soup.points.size(); ++i) {
    welded[i] = first_at.try_emplace(soup.points[i], static_cast<int>(i)).first->second;
    if (welded[i] != static_cast<int>(i)) ++changed.merged_vertices;
  }

  // Triangulate; neighbouring equal corners are one corner.
  std::vector<std::array<int, 3>> triangles;
  int begin = 0;
  for (const int end : soup.polygon_ends) {
    std::vector<int> polygon;
    for (int i = begin; i < end; ++i) {
      const int corner = welded[soup.corners[i]];
      if (polygon.empty() || polygon.back() != corner) polygon.push_back(corner);
    }
    while (polygon.size() > 1 && polygon.front() == polygon.back()) polygon.pop_back();
    if (end - begin > 3) ++changed.polygons_split;
    begin = end;
    if (polygon.size() < 3) {
      ++changed.degenerate_triangles;
      continue;
    }
    Triangulate(soup.points, std::move(polygon), triangles);
  }
  const auto repeats_a_corner = [](const std::array<int, 3>& t) {
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
  };
  changed.degenerate_triangles += static_cast<int>(std::erase_if(triangles, repeats_a_corner));
  if (triangles.empty())
    throw Error(Code::kBadMesh, "every triangle in this file has two corners on one point", file);

  // Keep the vertices that are used, in the order of the file.
  SurfaceMesh surface;
  std::vector<int> kept(soup.points.size(), -1);
  for (const auto& triangle : triangles)
    for (const int corner : triangle) kept[corner] = 0;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (kept[i] < 0) {
      if (welded[i] == static_cast<int>(i)) ++changed.unreferenced_vertices;
      continue;
    }
    kept[i] = static_cast<int>(surface.vertices.size());
    surface.vertices.push_back(soup.points[i] * metres_per_unit);
  }
  surface.triangles.reserve(triangles.size());
  for (const auto& [a, b, c] : triangles) surface.triangles.push_back({kept[a], kept[b], kept[c]});
  if (report) *report = changed;
  return surface;
}

}  // namespace arthro

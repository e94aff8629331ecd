#include "authoring/alignment/relief_distance.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "simulation/scene/backdrop/relief_surface.h"
#include "simulation/scene/mesh/vertex_normals.h"

namespace arthro::authoring {
namespace {

constexpr int kCells = 256;  // along the longer side of the panorama
// Cosine between a triangle and the line to the portal below which it spans a jump of the relief.
constexpr double kGrazing = 0.12;

}  // namespace

ReliefTarget MakeReliefTarget(const LoadedScene& scene) {
  ReliefTarget target;
  if (!scene.panorama) return target;
  ReliefSurface relief =
      MakeReliefSurface(scene.panorama->width, scene.panorama->height, OrEmpty(scene.depth),
                        scene.scene.backdrop, kCells, ReliefSample::kAtCorner);
  for (const auto& [a, b, c] : relief.mesh.triangles) {
    const auto at = [&](int i) { return relief.mesh.vertices[static_cast<std::size_t>(i)]; };
    const glm::dvec3 normal = glm::cross(at(b) - at(a), at(c) - at(a));
    const glm::dvec3 middle = (at(a) + at(b) + at(c)) / 3.0;
    const double length = glm::length(normal);
    if (!(length > 0)) continue;
    const double towards = -glm::dot(normal, middle) / (length * glm::length(middle));
    if (!(towards > kGrazing)) continue;
    target.surface.triangles.push_back({a, b, c});
    target.normals.push_back(normal / length);
  }
  target.surface.vertices = std::move(relief.mesh.vertices);
  if (!target.empty()) target.finder = std::make_shared<const SurfaceFinder>(target.surface);
  return target;
}

std::vector<double> DistancesFrom(const ReliefTarget& relief, const std::vector<glm::dvec3>& points,
                                  double reach) {
  std::vector<double> distances(points.size(), std::nan(""));
  if (relief.empty()) return distances;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const SurfacePoint nearest = relief.finder->Find(points[i], reach);
    if (nearest.triangle < 0) continue;
    const glm::dvec3 way = points[i] - nearest.place;
    const double side =
        glm::dot(way, relief.normals[static_cast<std::size_t>(nearest.triangle)]) < 0 ? -1 : 1;
    distances[i] = side * glm::length(way);
  }
  return distances;
}

std::vector<glm::dvec3> NormalsOf(const SurfaceMesh& surface) {
  std::vector<glm::dvec3> normals(surface.vertices.size());
  ComputeVertexNormals(surface.vertices, surface.triangles, normals);
  return normals;
}

ReliefFit FitOf(const ReliefTarget& relief, const SurfaceMesh& surface, const Pose& pose) {
  ReliefFit fit;
  if (relief.empty() || surface.vertices.empty()) return fit;
  const std::vector<glm::dvec3> normals = NormalsOf(surface);
  std::vector<glm::dvec3> points;
  std::vector<char> faces;
  for (std::size_t i = 0; i < surface.vertices.size(); ++i) {
    points.push_back(pose * surface.vertices[i]);
    faces.push_back(glm::dot(pose.quaternion * normals[i], points.back()) < 0);
  }
  const std::vector<double> distances = DistancesFrom(relief, points, kReliefReach);
  std::vector<double> unsigned_ones;
  std::size_t behind = 0;
  for (std::size_t i = 0; i < distances.size(); ++i) {
    if (std::isnan(distances[i])) continue;
    if (!faces[i]) continue;  // the back of a tissue that the relief shows lies behind it
    unsigned_ones.push_back(std::abs(distances[i]));
    if (distances[i] >= -kIntersecting) continue;
    ++behind;
    fit.deepest = std::max(fit.deepest, -distances[i]);
  }
  if (unsigned_ones.empty()) return fit;
  fit.is_known = true;
  fit.behind = static_cast<double>(behind) / static_cast<double>(unsigned_ones.size());
  const auto middle = unsigned_ones.begin() + static_cast<std::ptrdiff_t>(unsigned_ones.size() / 2);
  std::nth_element(unsigned_ones.begin(), middle, unsigned_ones.end());
  fit.median = *middle;
  fit.within = static_cast<double>(std::count_if(unsigned_ones.begin(), unsigned_ones.end(),
                                                 [](double d) { return d <= kGoodDistance; })) /
               static_cast<double>(unsigned_ones.size());
  return fit;
}

}  // namespace arthro::authoring

#include "authoring/phantom/look/tissue_caster.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "simulation/core/geometry/triangle.h"
#include "simulation/core/units.h"

namespace arthro::authoring {
namespace {

// Half-degree cells of latitude and longitude; a model's triangles span a few of them.
constexpr double kCell = RadiansFromDegrees(0.5);
constexpr int kColumns = 720, kRows = 360;

int ColumnOf(double longitude) {
  return std::clamp(static_cast<int>(std::floor((longitude + std::numbers::pi) / kCell)), 0,
                    kColumns - 1);
}
int RowOf(double latitude) {
  return std::clamp(static_cast<int>(std::floor((latitude + 0.5 * std::numbers::pi) / kCell)), 0,
                    kRows - 1);
}
double LongitudeOf(const glm::dvec3& x) { return std::atan2(x.x, x.z); }
double LatitudeOf(const glm::dvec3& x) {
  return -std::asin(std::clamp(x.y / glm::length(x), -1.0, 1.0));
}

std::size_t CellOf(const glm::dvec3& x) {
  return static_cast<std::size_t>(RowOf(LatitudeOf(x))) * kColumns + ColumnOf(LongitudeOf(x));
}

// Boxes of 2 mm about the portal.
constexpr double kBox = 2e-3;
constexpr int kBoxes = 56;
int BoxOf(double coordinate) {
  return std::clamp(static_cast<int>(std::floor(coordinate / kBox)) + kBoxes / 2, 0, kBoxes - 1);
}
constexpr double kReach = 1.9e-3;  // m, reach of a contact shadow

std::size_t BoxIndex(int i, int j, int k) {
  return (static_cast<std::size_t>(k) * kBoxes + j) * kBoxes + i;
}

}  // namespace

void TissueCaster::Add(const SurfaceMesh& mesh, Surface surface, const std::vector<double>& rims) {
  const int base = static_cast<int>(corners_.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    corners_.push_back({mesh.vertices[i], glm::dvec3(0.0), rims.empty() ? 0.0 : rims[i]});
  for (const auto& [a, b, c] : mesh.triangles) {
    triangles_.push_back({base + a, base + b, base + c, surface});
    // Area-weighted by the length of the cross product.
    const glm::dvec3 normal =
        glm::cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]);
    for (const int corner : {a, b, c}) corners_[base + corner].normal += normal;
  }
}

void TissueCaster::Sort() {
  cells_.assign(static_cast<std::size_t>(kColumns) * kRows, {});
  boxes_.assign(static_cast<std::size_t>(kBoxes) * kBoxes * kBoxes, {});
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    double lon_from = 10, lon_to = -10, lat_from = 10, lat_to = -10;
    for (const int corner : {triangles_[i].a, triangles_[i].b, triangles_[i].c}) {
      const double longitude = LongitudeOf(corners_[corner].x),
                   latitude = LatitudeOf(corners_[corner].x);
      lon_from = std::min(lon_from, longitude), lon_to = std::max(lon_to, longitude);
      lat_from = std::min(lat_from, latitude), lat_to = std::max(lat_to, latitude);
    }
    // A straight edge bows by far less than a fifth of a cell between its ends.
    for (int row = RowOf(lat_from - 0.2 * kCell); row <= RowOf(lat_to + 0.2 * kCell); ++row)
      for (int column = ColumnOf(lon_from - 0.2 * kCell); column <= ColumnOf(lon_to + 0.2 * kCell);
           ++column)
        cells_[static_cast<std::size_t>(row) * kColumns + column].push_back(static_cast<int>(i));
    const glm::dvec3 &a = corners_[triangles_[i].a].x, &b = corners_[triangles_[i].b].x,
                     &c = corners_[triangles_[i].c].x;
    const glm::dvec3 low = glm::min(a, glm::min(b, c)) - kReach,
                     high = glm::max(a, glm::max(b, c)) + kReach;
    for (int z = BoxOf(low.z); z <= BoxOf(high.z); ++z)
      for (int y = BoxOf(low.y); y <= BoxOf(high.y); ++y)
        for (int x = BoxOf(low.x); x <= BoxOf(high.x); ++x)
          boxes_[BoxIndex(x, y, z)].push_back(static_cast<int>(i));
  }
  for (Corner& corner : corners_) corner.normal = glm::normalize(corner.normal);
}

bool TissueCaster::MayHit(const glm::dvec3& d) const { return !cells_[CellOf(d)].empty(); }

std::optional<TissueHit> TissueCaster::Cast(const glm::dvec3& d) const {
  std::optional<TissueHit> nearest;
  for (const int index : cells_[CellOf(d)]) {
    const Triangle& triangle = triangles_[index];
    const Corner &a = corners_[triangle.a], &b = corners_[triangle.b], &c = corners_[triangle.c];
    // Signed volumes of the ray with each edge: the barycentric coordinates, up to scale. For
    // outward faces towards the portal all three are negative.
    const double u = glm::dot(d, glm::cross(b.x, c.x)), v = glm::dot(d, glm::cross(c.x, a.x));
    const double w = glm::dot(d, glm::cross(a.x, b.x));
    if (u > 0.0 || v > 0.0 || w > 0.0 || u + v + w == 0.0) continue;
    const double volume = glm::dot(a.x, glm::cross(b.x, c.x));
    const double distance = volume / (u + v + w);
    if (nearest && nearest->distance <= distance) continue;
    const double sum = u + v + w;
    nearest =
        TissueHit{distance, glm::normalize((u * a.normal + v * b.normal + w * c.normal) / sum),
                  triangle.surface, (u * a.rim + v * b.rim + w * c.rim) / sum};
  }
  return nearest;
}

double TissueCaster::ShadeAt(Surface surface, const glm::dvec3& x) const {
  if (surface != Surface::kPlateau && surface != Surface::kCondyle) return 1.0;
  double nearest2 = kReach * kReach;
  for (const int index : boxes_[BoxIndex(BoxOf(x.x), BoxOf(x.y), BoxOf(x.z))]) {
    const Triangle& t = triangles_[index];
    // The layer fills its bed flush and casts no shadow.
    if (t.surface == Surface::kCartilage) continue;
    nearest2 =
        std::min(nearest2, Distance2({corners_[t.a].x, corners_[t.b].x, corners_[t.c].x}, x));
  }
  const double share = std::sqrt(nearest2) / kReach;
  return 1.0 - 0.50 * (1.0 - share) * (1.0 - share);
}

}  // namespace arthro::authoring

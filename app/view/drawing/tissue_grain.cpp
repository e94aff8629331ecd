#include "app/view/drawing/tissue_grain.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <glm/geometric.hpp>

#include "simulation/core/units.h"
#include "simulation/scene/mesh/vertex_normals.h"

namespace arthro::app {
namespace {

constexpr double kRootReach = 4e-3;    // m, length of the roots at the ends of a crescent
constexpr double kBorderReach = 2e-3;  // m, width of a plate's border
constexpr double kSide = 0.6;          // cosine to the plane's normal; a side has less
constexpr int kSmoothings = 2;         // passes over the edges at neighbouring angles

}  // namespace

TissueGrain::TissueGrain(const SurfaceMesh& whole, simulation::TissueStructure structure)
    : structure_(structure) {
  if (structure == simulation::TissueStructure::kPlain || whole.vertices.size() < 4) {
    structure_ = simulation::TissueStructure::kPlain;
    return;
  }
  plane_ = FitPlane(whole.vertices);
  if (structure == simulation::TissueStructure::kFibres)
    FindCrescent(whole);
  else
    FindBorder(whole);
}

void TissueGrain::FindCrescent(const SurfaceMesh& whole) {
  const auto crescent = FitCrescent(whole.vertices, kBins);
  if (!crescent) {
    structure_ = simulation::TissueStructure::kPlain;
    plane_.axis = glm::dvec3(0.0);
    return;
  }
  plane_ = crescent->plane;
  radius_ = crescent->radius;
  begin_ = crescent->begin;
  sweep_ = crescent->sweep;

  // Edges per angle, from points along the sides of all triangles: a coarse surface has no vertex
  // of an edge in many a bin. One that is still without a point takes those of its neighbour.
  inner_.fill(std::numeric_limits<double>::infinity());
  outer_.fill(-std::numeric_limits<double>::infinity());
  const double most = 0.5 * radius_ * sweep_ / kBins;  // m, between two points
  const auto take = [&](const glm::dvec3& flat) {
    const double r = std::hypot(flat.x, flat.y);
    const double at =
        std::remainder(AngleInPlane(flat) - begin_ - 0.5 * sweep_, kRadianPerTurn) + 0.5 * sweep_;
    const auto bin = static_cast<std::size_t>(
        std::clamp(std::lround(at / sweep_ * kBins), 0L, static_cast<long>(kBins)));
    inner_[bin] = std::min(inner_[bin], r);
    outer_[bin] = std::max(outer_[bin], r);
  };
  for (const glm::dvec3& x : whole.vertices) take(plane_.InPlane(x));
  for (const auto& triangle : whole.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto corner = [&](std::size_t i) {
        return plane_.InPlane(whole.vertices[static_cast<std::size_t>(triangle[i % 3])]);
      };
      const glm::dvec3 from = corner(k), to = corner(k + 1);
      const double pieces = glm::distance(from, to) / most;
      const int count = pieces < kBins ? static_cast<int>(std::ceil(pieces)) : kBins;
      for (int i = 1; i < count; ++i) take(glm::mix(from, to, static_cast<double>(i) / count));
    }
  const auto fill = [&](std::size_t bin, std::size_t from) {
    if (outer_[bin] >= inner_[bin]) return;
    inner_[bin] = inner_[from];
    outer_[bin] = outer_[from];
  };
  for (std::size_t i = 1; i <= kBins; ++i) fill(i, i - 1);
  for (std::size_t i = kBins; i-- > 0;) fill(i, i + 1);
  for (int round = 0; round < kSmoothings; ++round)
    for (auto* edge : {&inner_, &outer_}) {
      const auto before = *edge;
      for (std::size_t i = 1; i < kBins; ++i)
        (*edge)[i] = 0.25 * before[i - 1] + 0.5 * before[i] + 0.25 * before[i + 1];
    }
  for (std::size_t i = 0; i <= kBins; ++i) width_ += (outer_[i] - inner_[i]) / (kBins + 1);
}

GrainPoint TissueGrain::InCrescent(const glm::dvec3& flat) const {
  const double at =
      std::remainder(AngleInPlane(flat) - begin_ - 0.5 * sweep_, kRadianPerTurn) + 0.5 * sweep_;
  const double share = std::clamp(at / sweep_, 0.0, 1.0) * kBins;
  const auto bin = std::min(static_cast<std::size_t>(share), static_cast<std::size_t>(kBins - 1));
  const double part = share - static_cast<double>(bin);
  const double inner = inner_[bin] + part * (inner_[bin + 1] - inner_[bin]);
  const double outer = outer_[bin] + part * (outer_[bin + 1] - outer_[bin]);
  GrainPoint point;
  const double wide = std::max(outer - inner, 1e-6);
  point.rim = std::clamp((std::hypot(flat.x, flat.y) - inner) / wide, 0.0, 1.0);
  point.place = {radius_ * at, point.rim * width_, flat.z};
  const double to_end = radius_ * std::min(at, sweep_ - at);
  point.root = std::clamp(1.0 - to_end / kRootReach, 0.0, 1.0);
  return point;
}

void TissueGrain::FindBorder(const SurfaceMesh& whole) {
  std::vector<glm::dvec3> normals(whole.vertices.size());
  ComputeVertexNormals(whole.vertices, whole.triangles, normals);
  for (std::size_t v = 0; v < normals.size(); ++v)
    if (std::abs(glm::dot(normals[v], plane_.axis)) < kSide) {
      glm::dvec3 flat = plane_.InPlane(whole.vertices[v]);
      flat.z = 0;
      border_.push_back(flat);
    }
}

glm::dvec3 TissueGrain::Along(const glm::dvec3& rest) const {
  if (structure_ != simulation::TissueStructure::kFibres) return glm::dvec3(0.0);
  const glm::dvec3 around = glm::cross(plane_.axis, rest - plane_.middle);
  const double length = glm::length(around);
  return length > 0.0 ? around / length : glm::dvec3(0.0);
}

GrainPoint TissueGrain::At(const glm::dvec3& rest, const glm::dvec3& normal) const {
  if (structure_ == simulation::TissueStructure::kPlain) return {rest, 0, 0};
  const glm::dvec3 flat = plane_.InPlane(rest);
  if (structure_ == simulation::TissueStructure::kFibres) return InCrescent(flat);
  GrainPoint point{flat, 0, 0};
  double least2 = kBorderReach * kBorderReach;
  for (const glm::dvec3& at : border_) {
    const glm::dvec3 way(at.x - flat.x, at.y - flat.y, 0);
    least2 = std::min(least2, glm::dot(way, way));
  }
  point.rim = 1.0 - std::sqrt(least2) / kBorderReach;
  point.root = 1.0 - std::abs(glm::dot(normal, plane_.axis));
  return point;
}

}  // namespace arthro::app

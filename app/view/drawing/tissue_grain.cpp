#include "app/view/drawing/tissue_grain.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "simulation/scene/vertex_normals.h"

namespace arthro::app {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kRootReach = 4e-3;    // m, length of the roots at the ends of a crescent
constexpr double kBorderReach = 2e-3;  // m, width of a plate's border
constexpr double kSide = 0.6;          // cosine to the plane's normal; a side has less
constexpr int kSmoothings = 2;         // passes over the edges at neighbouring angles

glm::dvec3 MiddleOf(std::span<const glm::dvec3> points) {
  glm::dvec3 sum(0.0);
  for (const glm::dvec3& x : points) sum += x;
  return points.empty() ? sum : sum / static_cast<double>(points.size());
}

// Returns the direction of the least spread, by the power method on the inverse covariance.
glm::dvec3 Flattest(std::span<const glm::dvec3> points, const glm::dvec3& middle) {
  glm::dmat3 spread(0.0);
  for (const glm::dvec3& x : points) spread += glm::outerProduct(x - middle, x - middle);
  const double size = spread[0][0] + spread[1][1] + spread[2][2];
  if (!(size > 0.0)) return {0, 0, 1};
  constexpr double kThin = 1e-6;  // keeps the covariance of a flat sheet regular
  for (int a = 0; a < 3; ++a) spread[a][a] += kThin * size;
  const glm::dmat3 inverse = glm::inverse(spread);
  glm::dvec3 axis = glm::normalize(glm::dvec3(0.1, 0.2, 1.0));
  constexpr int kRounds = 60;
  for (int i = 0; i < kRounds; ++i) axis = glm::normalize(inverse * axis);
  return axis;
}

double AngleOf(const glm::dvec3& flat) {
  const double angle = std::atan2(flat.y, flat.x);
  return angle < 0 ? angle + kTurn : angle;
}

}  // namespace

TissueGrain::TissueGrain(const SurfaceMesh& whole, simulation::TissueStructure structure)
    : structure_(structure) {
  if (structure == simulation::TissueStructure::kPlain || whole.vertices.size() < 4) {
    structure_ = simulation::TissueStructure::kPlain;
    return;
  }
  middle_ = MiddleOf(whole.vertices);
  axis_ = Flattest(whole.vertices, middle_);
  const glm::dvec3 aside = std::abs(axis_.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  across_ = glm::normalize(aside - glm::dot(aside, axis_) * axis_);
  along_ = glm::cross(axis_, across_);
  if (structure == simulation::TissueStructure::kFibres)
    FindCrescent(whole);
  else
    FindBorder(whole);
}

glm::dvec3 TissueGrain::InPlane(const glm::dvec3& x) const {
  const glm::dvec3 from = x - middle_;
  return {glm::dot(from, across_), glm::dot(from, along_), glm::dot(from, axis_)};
}

void TissueGrain::FindCrescent(const SurfaceMesh& whole) {
  // Circle x² + y² = a x + b y + c.
  glm::dmat3 normal(0.0);
  glm::dvec3 right(0.0);
  for (const glm::dvec3& x : whole.vertices) {
    const glm::dvec3 flat = InPlane(x), row(flat.x, flat.y, 1.0);
    normal += glm::outerProduct(row, row);
    right += (flat.x * flat.x + flat.y * flat.y) * row;
  }
  if (!(std::abs(glm::determinant(normal)) > 0.0)) {
    structure_ = simulation::TissueStructure::kPlain;
    axis_ = glm::dvec3(0.0);
    return;
  }
  const glm::dvec3 circle = glm::inverse(normal) * right;
  middle_ += 0.5 * circle.x * across_ + 0.5 * circle.y * along_;
  radius_ =
      std::sqrt(std::max(circle.z + 0.25 * (circle.x * circle.x + circle.y * circle.y), 1e-12));

  // Ends at the largest gap of angles.
  std::array<bool, 4 * kBins> is_taken{};
  const auto fine = static_cast<int>(is_taken.size());
  for (const glm::dvec3& x : whole.vertices)
    is_taken[static_cast<std::size_t>(
        std::min(static_cast<int>(AngleOf(InPlane(x)) / kTurn * fine), fine - 1))] = true;
  int gap = 0, gap_end = 0;
  for (int i = 0, free = 0; i < 2 * fine; ++i) {
    free = is_taken[static_cast<std::size_t>(i % fine)] ? 0 : free + 1;
    if (free > gap && free <= fine) gap = free, gap_end = i;
  }
  begin_ = kTurn * (gap_end + 1) / fine;
  sweep_ = kTurn * std::max(fine - gap, 1) / fine;

  // Edges per angle; a bin without a vertex takes those of its neighbour.
  inner_.fill(std::numeric_limits<double>::infinity());
  outer_.fill(-std::numeric_limits<double>::infinity());
  for (const glm::dvec3& x : whole.vertices) {
    const glm::dvec3 flat = InPlane(x);
    const double r = std::hypot(flat.x, flat.y);
    const double at = std::remainder(AngleOf(flat) - begin_ - 0.5 * sweep_, kTurn) + 0.5 * sweep_;
    const auto bin = static_cast<std::size_t>(
        std::clamp(std::lround(at / sweep_ * kBins), 0L, static_cast<long>(kBins)));
    inner_[bin] = std::min(inner_[bin], r);
    outer_[bin] = std::max(outer_[bin], r);
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
  const double at = std::remainder(AngleOf(flat) - begin_ - 0.5 * sweep_, kTurn) + 0.5 * sweep_;
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
    if (std::abs(glm::dot(normals[v], axis_)) < kSide) {
      glm::dvec3 flat = InPlane(whole.vertices[v]);
      flat.z = 0;
      border_.push_back(flat);
    }
}

GrainPoint TissueGrain::At(const glm::dvec3& rest, const glm::dvec3& normal) const {
  if (structure_ == simulation::TissueStructure::kPlain) return {rest, 0, 0};
  const glm::dvec3 flat = InPlane(rest);
  if (structure_ == simulation::TissueStructure::kFibres) return InCrescent(flat);
  GrainPoint point{flat, 0, 0};
  double least2 = kBorderReach * kBorderReach;
  for (const glm::dvec3& at : border_) {
    const glm::dvec3 way(at.x - flat.x, at.y - flat.y, 0);
    least2 = std::min(least2, glm::dot(way, way));
  }
  point.rim = 1.0 - std::sqrt(least2) / kBorderReach;
  point.root = 1.0 - std::abs(glm::dot(normal, axis_));
  return point;
}

}  // namespace arthro::app

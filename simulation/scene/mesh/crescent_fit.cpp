#include "simulation/scene/mesh/crescent_fit.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace arthro {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

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

}  // namespace

glm::dvec3 PlaneFit::InPlane(const glm::dvec3& x) const {
  const glm::dvec3 from = x - middle;
  return {glm::dot(from, across), glm::dot(from, along), glm::dot(from, axis)};
}

PlaneFit FitPlane(std::span<const glm::dvec3> points) {
  PlaneFit plane;
  plane.middle = MiddleOf(points);
  plane.axis = Flattest(points, plane.middle);
  const glm::dvec3 aside = std::abs(plane.axis.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  plane.across = glm::normalize(aside - glm::dot(aside, plane.axis) * plane.axis);
  plane.along = glm::cross(plane.axis, plane.across);
  return plane;
}

double AngleInPlane(const glm::dvec3& flat) {
  const double angle = std::atan2(flat.y, flat.x);
  return angle < 0 ? angle + kTurn : angle;
}

std::optional<CrescentFit> FitCrescent(std::span<const glm::dvec3> points, int bins) {
  CrescentFit crescent;
  PlaneFit& plane = crescent.plane;
  plane = FitPlane(points);
  // Circle x² + y² = a x + b y + c.
  glm::dmat3 normal(0.0);
  glm::dvec3 right(0.0);
  for (const glm::dvec3& x : points) {
    const glm::dvec3 flat = plane.InPlane(x), row(flat.x, flat.y, 1.0);
    normal += glm::outerProduct(row, row);
    right += (flat.x * flat.x + flat.y * flat.y) * row;
  }
  if (!(std::abs(glm::determinant(normal)) > 0.0)) {
    return {};
  }
  const glm::dvec3 circle = glm::inverse(normal) * right;
  plane.middle += 0.5 * circle.x * plane.across + 0.5 * circle.y * plane.along;
  crescent.radius =
      std::sqrt(std::max(circle.z + 0.25 * (circle.x * circle.x + circle.y * circle.y), 1e-12));

  // Ends at the largest gap of angles.
  const int fine = 4 * bins;
  std::vector<bool> is_taken(static_cast<std::size_t>(fine), false);
  for (const glm::dvec3& x : points)
    is_taken[static_cast<std::size_t>(std::min(
        static_cast<int>(AngleInPlane(plane.InPlane(x)) / kTurn * fine), fine - 1))] = true;
  int gap = 0, gap_end = 0;
  for (int i = 0, free = 0; i < 2 * fine; ++i) {
    free = is_taken[static_cast<std::size_t>(i % fine)] ? 0 : free + 1;
    if (free > gap && free <= fine) gap = free, gap_end = i;
  }
  crescent.begin = kTurn * (gap_end + 1) / fine;
  crescent.sweep = kTurn * std::max(fine - gap, 1) / fine;
  return crescent;
}

}  // namespace arthro

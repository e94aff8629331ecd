#include "simulation/tissue/contact/closest_points.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "simulation/tissue/fem/tet_shape.h"

namespace arthro::simulation {
namespace {

// Sine of the angle below which a segment counts as parallel to a line or a face. The middle of the
// stretch is then as near as its ends to 1e-6 of its length.
constexpr double kParallel = 1e-6;

// Squared distance divided by area below which a point of a triangle's plane lies on the triangle.
constexpr double kRounding = 1e-20;

// Finds the middle of the part of p + t d, t in [low, high], that projects onto c + s e with 0 ≤ s
// ≤ 1, for parallel directions. Returns false if there is none.
bool ParallelMiddle(const glm::dvec3& p, const glm::dvec3& d, const glm::dvec3& c,
                    const glm::dvec3& e, double& t) noexcept {
  const double dd = glm::dot(d, d);
  const double t0 = glm::dot(c - p, d) / dd, t1 = glm::dot(c + e - p, d) / dd;
  const double low = std::max(0.0, std::min(t0, t1)), high = std::min(1.0, std::max(t0, t1));
  if (!(low <= high)) return false;
  t = 0.5 * (low + high);
  return true;
}

// Finds the closest points of the segments p + t d and c + s e.
double ClosestSegments(const glm::dvec3& p, const glm::dvec3& d, const glm::dvec3& c,
                       const glm::dvec3& e, double& t, double& s) noexcept {
  const glm::dvec3 r = p - c;
  const double dd = glm::dot(d, d), ee = glm::dot(e, e), de = glm::dot(d, e);
  const double dr = glm::dot(d, r), er = glm::dot(e, r);
  const double det = dd * ee - de * de;
  if (!(ee > 0.0)) {
    s = 0.0;
    t = dd > 0.0 ? std::clamp(-dr / dd, 0.0, 1.0) : 0.0;
  } else if (!(dd > 0.0)) {
    t = 0.0;
    s = std::clamp(er / ee, 0.0, 1.0);
  } else if (det > kParallel * kParallel * dd * ee) {
    t = std::clamp((de * er - ee * dr) / det, 0.0, 1.0);
    s = std::clamp((de * t + er) / ee, 0.0, 1.0);
    t = std::clamp((de * s - dr) / dd, 0.0, 1.0);
  } else {
    if (!ParallelMiddle(p, d, c, e, t)) t = std::clamp(-dr / dd, 0.0, 1.0);
    s = std::clamp((de * t + er) / ee, 0.0, 1.0);
    t = std::clamp((de * s - dr) / dd, 0.0, 1.0);
  }
  const glm::dvec3 gap = r + t * d - s * e;
  return glm::dot(gap, gap);
}

}  // namespace

glm::dvec4 ClosestInTetrahedron(const std::array<glm::dvec3, 4>& corner,
                                const glm::dvec3& x) noexcept {
  const glm::dvec4 l = BarycentricIn(corner, x);
  if (l.x >= 0.0 && l.y >= 0.0 && l.z >= 0.0 && l.w >= 0.0) return l;
  // Outside, the nearest point lies on a face visible from x.
  constexpr std::array<std::array<int, 3>, 4> kFaceWithout{
      {{1, 2, 3}, {0, 2, 3}, {0, 1, 3}, {0, 1, 2}}};
  double best = std::numeric_limits<double>::max();
  glm::dvec4 nearest(1, 0, 0, 0);
  for (int i = 0; i < 4; ++i) {
    if (l[i] >= 0.0) continue;
    const auto& face = kFaceWithout[static_cast<std::size_t>(i)];
    TriangleCorners triangle;
    for (std::size_t j = 0; j < 3; ++j) triangle[j] = corner[static_cast<std::size_t>(face[j])];
    const glm::dvec3 on = ClosestOnTriangle(triangle, x), way = x - PointOn(triangle, on);
    const double distance2 = glm::dot(way, way);
    if (!(distance2 < best)) continue;
    best = distance2;
    nearest = glm::dvec4(0.0);
    for (int j = 0; j < 3; ++j) nearest[face[static_cast<std::size_t>(j)]] = on[j];
  }
  return nearest;
}

SegmentTriangle ClosestSegmentTriangle(const glm::dvec3& a, const glm::dvec3& b,
                                       const TriangleCorners& corner) noexcept {
  SegmentTriangle best;
  best.distance2 = std::numeric_limits<double>::max();
  const glm::dvec3 way = b - a;
  const auto keep = [&best](double along, const glm::dvec3& l, double distance2) noexcept {
    if (!(distance2 < best.distance2)) return;
    best = {along, l, distance2};
  };
  const glm::dvec3 normal = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
  const double area2 = glm::dot(normal, normal), up = glm::dot(way, normal);
  const double length2 = glm::dot(way, way);
  const auto at_point = [&](double along) noexcept {
    const glm::dvec3 x = a + along * way, l = ClosestOnTriangle(corner, x),
                     gap = x - PointOn(corner, l);
    return SegmentTriangle{along, l, glm::dot(gap, gap)};
  };
  // Segment above the face and parallel to it: the middle of the stretch over the face.
  if (area2 > 0.0 && up * up <= kParallel * kParallel * area2 * length2) {
    double low = 0.0, high = 1.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::dvec3 inwards = glm::cross(normal, corner[(i + 1) % 3] - corner[i]);
      const double h = glm::dot(a - corner[i], inwards), slope = glm::dot(way, inwards);
      if (slope > 0.0)
        low = std::max(low, -h / slope);
      else if (slope < 0.0)
        high = std::min(high, -h / slope);
      else if (h < 0.0)
        high = -1.0;
    }
    if (low <= high) return at_point(0.5 * (low + high));
  }
  // Segment through the face.
  if (area2 > 0.0 && up != 0.0) {
    const double t = glm::dot(corner[0] - a, normal) / up;
    if (t >= 0.0 && t <= 1.0) {
      SegmentTriangle through = at_point(t);
      if (through.distance2 <= kRounding * std::sqrt(area2)) {
        through.distance2 = 0.0;
        return through;
      }
    }
  }
  // Otherwise an edge is nearest to the segment, or the face to one of its ends.
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const glm::dvec3& c = corner[static_cast<std::size_t>(i)];
    double t = 0, s = 0;
    const double distance2 =
        ClosestSegments(a, way, c, corner[static_cast<std::size_t>(j)] - c, t, s);
    glm::dvec3 l(0.0);
    l[i] = 1.0 - s;
    l[j] = s;
    keep(t, l, distance2);
  }
  for (double end : {0.0, 1.0}) {
    const SegmentTriangle point = at_point(end);
    keep(point.along, point.triangle, point.distance2);
  }
  return best;
}

}  // namespace arthro::simulation

// Segment between two points: its nearest points to another one, and what it crosses. m; noexcept,
// allocates nothing.
#pragma once

#include <algorithm>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "simulation/core/geometry/box3.h"
#include "simulation/core/geometry/triangle.h"

namespace arthro {

struct Segment3 {
  glm::dvec3 a{0.0}, b{0.0};
};

// Nearest points of two segments, as shares of them, by clamping those of the two lines [Ericson
// 2005, 5.1.9].
struct NearestShares {
  double first = 0, second = 0;
};
inline NearestShares NearestOf(const Segment3& one, const Segment3& two) noexcept {
  const glm::dvec3 along = one.b - one.a, other = two.b - two.a, between = one.a - two.a;
  const double a = glm::dot(along, along), e = glm::dot(other, other), f = glm::dot(other, between),
               c = glm::dot(along, between), b = glm::dot(along, other),
               denominator = a * e - b * b;
  NearestShares shares;
  if (denominator > 1e-18) shares.first = std::clamp((b * f - c * e) / denominator, 0.0, 1.0);
  shares.second = e > 0 ? (b * shares.first + f) / e : 0;
  if (shares.second < 0 || shares.second > 1) {
    shares.second = std::clamp(shares.second, 0.0, 1.0);
    shares.first = a > 0 ? std::clamp((b * shares.second - c) / a, 0.0, 1.0) : 0;
  }
  return shares;
}

// Returns the squared distance of two segments.
inline double Distance2(const Segment3& one, const Segment3& two) noexcept {
  const NearestShares shares = NearestOf(one, two);
  const glm::dvec3 gap =
      one.a + shares.first * (one.b - one.a) - two.a - shares.second * (two.b - two.a);
  return glm::dot(gap, gap);
}

// Returns true where the segment crosses a triangle, from either side [Möller & Trumbore 1997].
inline bool Crosses(const Segment3& segment, const TriangleCorners& corner) noexcept {
  const glm::dvec3 way = segment.b - segment.a, side = corner[1] - corner[0],
                   other = corner[2] - corner[0], across = glm::cross(way, other);
  const double det = glm::dot(side, across);
  if (det == 0.0) return false;
  const glm::dvec3 from = segment.a - corner[0], turned = glm::cross(from, side);
  const double u = glm::dot(from, across) / det, v = glm::dot(way, turned) / det,
               t = glm::dot(other, turned) / det;
  return u >= 0 && v >= 0 && u + v <= 1 && t >= 0 && t <= 1;
}

// Returns 0 where the segment meets the box, and infinity elsewhere, for the search of a BoxTree.
inline double Distance2(const Box3& box, const Segment3& segment) noexcept {
  constexpr double kRounding = 1e-12;  // m
  double begin = 0, end = 1;
  for (int i = 0; i < 3; ++i) {
    const double way = segment.b[i] - segment.a[i];
    const double low = box.low[i] - kRounding - segment.a[i],
                 high = box.high[i] + kRounding - segment.a[i];
    if (way == 0.0) {
      if (low > 0 || high < 0) return std::numeric_limits<double>::infinity();
      continue;
    }
    const double one = low / way, two = high / way;
    begin = std::max(begin, std::min(one, two));
    end = std::min(end, std::max(one, two));
  }
  return begin <= end ? 0.0 : std::numeric_limits<double>::infinity();
}

}  // namespace arthro

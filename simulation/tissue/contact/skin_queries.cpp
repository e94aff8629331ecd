// Contacts of one piece of a tool: from outside exactly, from inside by the distance field at rest.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "simulation/tissue/contact/closest_points.h"
#include "simulation/tissue/contact/tool_contact.h"

namespace arthro::simulation {
namespace {

// Distance to the skin below which the direction to it is undefined.
constexpr double kOnSkin = 1e-9;  // m

// Part of a tool that must stay outside the skin while it follows its hand; the rest is room to
// slide on a curved skin.
constexpr double kCore = 0.5;  // fraction of the radius

}  // namespace

TriangleCorners SkinContact::Corners(int triangle) const noexcept {
  const auto& [a, b, c] = skin_->rest.triangles[static_cast<std::size_t>(triangle)];
  return {positions_[static_cast<std::size_t>(a)], positions_[static_cast<std::size_t>(b)],
          positions_[static_cast<std::size_t>(c)]};
}

Box3 SkinContact::BoxOf(int triangle) const noexcept {
  const TriangleCorners x = Corners(triangle);
  return {glm::min(glm::min(x[0], x[1]), x[2]), glm::max(glm::max(x[0], x[1]), x[2])};
}

glm::dvec3 SkinContact::Blend(const OnSkin& on, const std::vector<glm::dvec3>& of) const noexcept {
  const auto& [a, b, c] = skin_->rest.triangles[static_cast<std::size_t>(on.triangle)];
  return on.at.x * of[static_cast<std::size_t>(a)] + on.at.y * of[static_cast<std::size_t>(b)] +
         on.at.z * of[static_cast<std::size_t>(c)];
}

SkinContact::OnSkin SkinContact::NearestTo(const glm::dvec3& x, double limit) const noexcept {
  OnSkin nearest;
  double limit2 = limit * limit;
  tree_.ForNear(x, limit2, [&](int i) noexcept {
    const TriangleCorners corner = Corners(i);
    const glm::dvec3 l = ClosestOnTriangle(corner, x), way = x - PointOn(corner, l);
    const double distance2 = glm::dot(way, way);
    if (!(distance2 <= limit2)) return;
    // Two adjacent triangles are equally near at their edge; the lower index wins, whatever the
    // tree's order.
    if (distance2 == limit2 && nearest.triangle >= 0 && i > nearest.triangle) return;
    nearest = {i, l, distance2};
    limit2 = distance2;
  });
  return nearest;
}

double SkinContact::NearestAlong(const Piece& piece, double limit, double& along) const noexcept {
  const Box3 box{glm::min(piece.a, piece.b), glm::max(piece.a, piece.b)};
  double limit2 = limit * limit;
  bool is_found = false;
  tree_.ForNear(box, limit2, [&](int i) noexcept {
    if (Distance2(BoxOf(i), box) > limit2) return;
    const SegmentTriangle nearest = ClosestSegmentTriangle(piece.a, piece.b, Corners(i));
    if (!(nearest.distance2 < limit2)) return;
    along = nearest.along;
    limit2 = nearest.distance2;
    is_found = true;
  });
  return is_found ? std::sqrt(limit2) : std::numeric_limits<double>::max();
}

bool SkinContact::IsInside(const glm::dvec3& x) const noexcept {
  EmbeddedPoint point;
  glm::dvec3 rest;
  return finder_.FindDeformed(x, point, rest) && field_->Distance(rest) < 0.0;
}

// Finds the shortest way out at rest and maps it to the deformed body: the skin's normal transforms
// with the cofactor of F (Nanson), n ∝ det(F) F⁻ᵀ ∇φ.
bool SkinContact::TouchFromInside(const Piece& piece, Touch& touch) const noexcept {
  double deepest = 0.0;
  bool is_found = false;
  for (const double along : {0.5, 0.0, 1.0}) {
    const glm::dvec3 x = piece.a + along * (piece.b - piece.a);
    EmbeddedPoint point;
    glm::dvec3 rest;
    glm::dmat3 f;
    if (!finder_.FindDeformed(x, point, rest, f)) continue;
    if (!(field_->Distance(rest) < 0.0)) continue;
    // Projects onto the surface by two steps along the gradient, because φ is only approximately a
    // distance.
    glm::dvec3 surface = rest, slope(0.0);
    for (int step = 0; step < 2; ++step) {
      slope = field_->Gradient(surface);
      const double slope2 = glm::dot(slope, slope);
      if (!(slope2 > 0.25)) break;
      surface -= field_->Distance(surface) / slope2 * slope;
    }
    glm::dvec3 normal = slope.x * glm::cross(f[1], f[2]) + slope.y * glm::cross(f[2], f[0]) +
                        slope.z * glm::cross(f[0], f[1]);
    const double length = glm::length(normal);
    const std::array<int, 1> beside{point.element};
    EmbeddedPoint on = finder_.FindBeside(surface, beside);
    glm::dvec3 skin = finder_.PlaceNow(on);
    double distance = length > 0.0 ? glm::dot(normal / length, x - skin) : 0.0;
    const bool has_way = glm::dot(slope, slope) > 0.25 && distance < 0.0;
    if (has_way) {
      normal /= length;
    } else {
      // Deeper than the field's band, or inverted: uses the nearest skin as it is now.
      const OnSkin nearest = NearestTo(x, std::numeric_limits<double>::max());
      if (nearest.triangle < 0) continue;
      const auto& triangle = skin_->rest.triangles[static_cast<std::size_t>(nearest.triangle)];
      skin = Blend(nearest, positions_);
      distance = -std::sqrt(nearest.distance2);
      if (!(distance < -kOnSkin)) continue;
      normal = (skin - x) / -distance;
      on = finder_.FindBeside(
          Blend(nearest, skin_->rest.vertices),
          std::array{skin_->point[static_cast<std::size_t>(triangle[0])].element});
    }
    if (on.element < 0 || !(distance < deepest)) continue;
    deepest = distance;
    is_found = true;
    touch.axis = x;
    touch.normal = normal;
    touch.point = on;
    touch.gap = distance - piece.radius;
  }
  return is_found;
}

double SkinContact::Clearance(std::span<const Piece> pieces, const glm::dvec3& offset,
                              double limit) const noexcept {
  double least = limit;
  for (const Piece& piece : pieces) {
    const Piece moved{piece.a + offset, piece.b + offset, piece.radius};
    const double core = kCore * piece.radius;
    double along = 0;
    const double nearest = NearestAlong(moved, least + core, along);
    if (nearest < least + core) least = nearest - core;
    if (least <= 0.0) return least;
  }
  return least;
}

}  // namespace arthro::simulation

#include "simulation/scene/solids/solid_bounds.h"

#include <array>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>

namespace arthro {
namespace {

constexpr double kEndless = std::numeric_limits<double>::infinity();

// Half sizes of a part along its own axes.
struct HalfSize {
  glm::dvec3 operator()(const EllipsoidPart& p) const { return p.radii; }
  glm::dvec3 operator()(const CapsulePart& p) const {
    return {p.radius, p.radius, p.radius + 0.5 * p.length};
  }
  glm::dvec3 operator()(const TorusPart& p) const {
    const double around = p.ring_radius + p.tube_radius;
    return {around, around, p.tube_radius};
  }
  glm::dvec3 operator()(const BoxPart& p) const { return p.half; }
  glm::dvec3 operator()(const PlanePart&) const { return glm::dvec3(kEndless); }
};

Box3 BoundsOfPart(const SolidPart& part) {
  const glm::dvec3 half = std::visit(HalfSize{}, part);
  const Rigid3& pose = PlaceOf(part).solid_from_part;
  if (!std::isfinite(half.x)) return {glm::dvec3(-kEndless), glm::dvec3(kEndless)};
  const glm::dmat3 turn = glm::mat3_cast(glm::normalize(pose.rotation));
  const glm::dvec3 around =
      glm::abs(turn[0]) * half.x + glm::abs(turn[1]) * half.y + glm::abs(turn[2]) * half.z;
  return {pose.translation - around, pose.translation + around};
}

// A blended union bulges by a quarter of the blend at most. A blended intersection or difference
// only loses.
Box3 Joined(const Box3& a, const Box3& b, SolidJoin join, double blend) {
  if (join == SolidJoin::kDifference) return a;
  if (join == SolidJoin::kIntersection) return {glm::max(a.low, b.low), glm::min(a.high, b.high)};
  Box3 both = Union(a, b);
  if (!both.empty()) {
    both.low -= 0.25 * blend;
    both.high += 0.25 * blend;
  }
  return both;
}

}  // namespace

Box3 BoundsOfSolid(const Solid& solid) {
  struct Group {
    Box3 box = kEmptyBox;
    SolidJoin join = SolidJoin::kUnion;
    double blend = 0;
  };
  std::array<Group, kDeepestSolidLevel + 1> group;
  int level = 0;
  const auto close = [&] {
    const Group& inner = group[static_cast<std::size_t>(level)];
    Group& outer = group[static_cast<std::size_t>(--level)];
    outer.box = Joined(outer.box, inner.box, inner.join, inner.blend);
  };
  for (std::size_t i = 0; i < solid.parts.size(); ++i) {
    const SolidPlace& place = PlaceOf(solid.parts[i]);
    const Box3 box = BoundsOfPart(solid.parts[i]);
    while (place.level < level) close();
    if (place.level > level || i == 0) {
      level = place.level;
      group[static_cast<std::size_t>(level)] = {box, place.join, place.blend};
    } else {
      Group& own = group[static_cast<std::size_t>(level)];
      own.box = Joined(own.box, box, place.join, place.blend);
    }
  }
  while (level > 0) close();
  return group[0].box;
}

}  // namespace arthro

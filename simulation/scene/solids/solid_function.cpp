#include "simulation/scene/solids/solid_function.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "simulation/core/error.h"
#include "simulation/scene/solids/ellipsoid_distance.h"
#include "simulation/scene/solids/solid_bounds.h"

namespace arthro {
namespace {

// Unit vector along v; `otherwise` where v has no length.
glm::dvec3 Along(const glm::dvec3& v, double length, const glm::dvec3& otherwise) noexcept {
  return length > 0.0 ? v / length : otherwise;
}

// Polynomial smooth minimum, which differs from the minimum where the values are less than `blend`
// apart. Its gradient is a mean of both, so its slope stays 1 at most.
template <bool has_gradient>
SolidSample SmoothLeast(const SolidSample& a, const SolidSample& b, double blend) noexcept {
  const bool is_a = a.value < b.value;
  const SolidSample &less = is_a ? a : b, &more = is_a ? b : a;
  const double apart = more.value - less.value;
  if (!(apart < blend)) return less;
  const double part = 1.0 - apart / blend;
  SolidSample joined;
  joined.value = less.value - 0.25 * blend * part * part;
  if constexpr (has_gradient)
    joined.gradient = (1.0 - 0.5 * part) * less.gradient + 0.5 * part * more.gradient;
  return joined;
}

SolidSample Inverted(const SolidSample& a) noexcept { return {-a.value, -a.gradient}; }

template <bool has_gradient>
SolidSample Joined(const SolidSample& a, const SolidSample& b, SolidJoin join,
                   double blend) noexcept {
  if (join == SolidJoin::kUnion) return SmoothLeast<has_gradient>(a, b, blend);
  return Inverted(SmoothLeast<has_gradient>(
      Inverted(a), join == SolidJoin::kDifference ? b : Inverted(b), blend));
}

}  // namespace

SolidFunction::SolidFunction(const Solid& solid) {
  if (const std::string fault = FaultOfSolid(solid); !fault.empty())
    throw Error(Code::kBadMesh, fault);
  bounds_ = BoundsOfSolid(solid);
  struct Size {
    Part& part;
    void operator()(const EllipsoidPart& p) const {
      part.kind = Kind::kEllipsoid;
      part.size = p.radii;
    }
    void operator()(const CapsulePart& p) const {
      part.kind = Kind::kCapsule;
      part.size = {0.5 * p.length, p.radius, 0.0};
    }
    void operator()(const TorusPart& p) const {
      part.kind = Kind::kTorus;
      part.size = {p.ring_radius, p.tube_radius, 0.0};
    }
    void operator()(const BoxPart& p) const {
      part.kind = Kind::kBox;
      part.size = p.half - p.rounding;
      part.rounding = p.rounding;
    }
    void operator()(const PlanePart&) const { part.kind = Kind::kPlane; }
  };
  for (const SolidPart& from : solid.parts) {
    const SolidPlace& place = PlaceOf(from);
    Part& part = parts_.emplace_back();
    std::visit(Size{part}, from);
    part.join = place.join;
    part.level = place.level;
    part.blend = place.blend;
    part.centre = place.solid_from_part.translation;
    part.part_from_solid =
        glm::mat3_cast(glm::conjugate(glm::normalize(place.solid_from_part.rotation)));
  }
}

template <bool has_gradient>
SolidSample SolidFunction::OfPart(const Part& part, const glm::dvec3& x) noexcept {
  const glm::dvec3 p = part.part_from_solid * (x - part.centre);
  SolidSample own;
  switch (part.kind) {
    case Kind::kEllipsoid: {
      const EllipsoidDistance distance = DistanceToEllipsoid(part.size, p);
      own = {distance.value, distance.normal};
      break;
    }
    case Kind::kCapsule: {
      const glm::dvec3 off{p.x, p.y, p.z - std::clamp(p.z, -part.size.x, part.size.x)};
      const double length = glm::length(off);
      own = {length - part.size.y, Along(off, length, {1, 0, 0})};
      break;
    }
    case Kind::kTorus: {
      const double around = std::hypot(p.x, p.y);
      const glm::dvec3 out = Along({p.x, p.y, 0.0}, around, {1, 0, 0});
      const glm::dvec3 off = (around - part.size.x) * out + glm::dvec3(0.0, 0.0, p.z);
      const double length = glm::length(off);
      own = {length - part.size.y, Along(off, length, {0, 0, 1})};
      break;
    }
    case Kind::kBox: {
      const glm::dvec3 over = glm::abs(p) - part.size, out = glm::max(over, glm::dvec3(0.0));
      const double length = glm::length(out);
      int axis = over.x > over.y ? 0 : 1;
      if (over.z > over[axis]) axis = 2;
      glm::dvec3 toward(0.0);
      toward[axis] = 1.0;
      own = {length + std::min(0.0, over[axis]) - part.rounding, Along(out, length, toward)};
      for (int a = 0; a < 3; ++a) own.gradient[a] = std::copysign(own.gradient[a], p[a]);
      break;
    }
    case Kind::kPlane:
      own = {p.z, {0, 0, 1}};
      break;
  }
  if constexpr (has_gradient) own.gradient = own.gradient * part.part_from_solid;
  return own;
}

template <bool has_gradient>
SolidSample SolidFunction::Evaluate(const glm::dvec3& x) const noexcept {
  struct Group {
    SolidSample sample;
    SolidJoin join = SolidJoin::kUnion;
    double blend = 0;
  };
  std::array<Group, kDeepestSolidLevel + 1> group;
  std::size_t level = 0;
  const auto close = [&] {
    const Group& inner = group[level];
    Group& outer = group[--level];
    outer.sample = Joined<has_gradient>(outer.sample, inner.sample, inner.join, inner.blend);
  };
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const Part& part = parts_[i];
    const auto its_level = static_cast<std::size_t>(part.level);
    while (its_level < level) close();  // NOLINT(bugprone-infinite-loop): it lowers the level
    const SolidSample own = OfPart<has_gradient>(part, x);
    if (its_level > level || i == 0) {
      level = its_level;
      group[level] = {own, part.join, part.blend};
    } else {
      SolidSample& sample = group[level].sample;
      sample = Joined<has_gradient>(sample, own, part.join, part.blend);
    }
  }
  while (level > 0) close();  // NOLINT(bugprone-infinite-loop): it lowers the level
  return group[0].sample;
}

double SolidFunction::Value(const glm::dvec3& x) const noexcept { return Evaluate<false>(x).value; }

SolidSample SolidFunction::Sample(const glm::dvec3& x) const noexcept { return Evaluate<true>(x); }

glm::dvec3 SolidFunction::Normal(const glm::dvec3& x) const noexcept {
  const glm::dvec3 gradient = Sample(x).gradient;
  const double length = glm::length(gradient);
  return length > 0.0 && std::isfinite(length) ? gradient / length : glm::dvec3(0, 0, 1);
}

}  // namespace arthro

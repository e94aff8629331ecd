#include "simulation/scene/solids/solid.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>

#include "simulation/core/finite.h"
#include "simulation/core/units.h"
#include "simulation/scene/solids/solid_bounds.h"

namespace arthro {
namespace {

// Larger than every joint; a solid of that size has another unit. m
constexpr double kLargestSolid = 0.3;

// Lengths of a part, as one list.
std::vector<double> LengthsOf(const SolidPart& part) {
  struct Lengths {
    std::vector<double> operator()(const EllipsoidPart& p) const {
      return {p.radii.x, p.radii.y, p.radii.z};
    }
    std::vector<double> operator()(const CapsulePart& p) const { return {p.length, p.radius}; }
    std::vector<double> operator()(const TorusPart& p) const {
      return {p.ring_radius, p.tube_radius};
    }
    std::vector<double> operator()(const BoxPart& p) const {
      return {p.half.x, p.half.y, p.half.z};
    }
    std::vector<double> operator()(const PlanePart&) const { return {}; }
  };
  return std::visit(Lengths{}, part);
}

std::string FaultOfPart(const SolidPart& part) {
  const SolidPlace& place = PlaceOf(part);
  const glm::dquat& q = place.solid_from_part.rotation;
  for (const double length : LengthsOf(part))
    if (!(length > 0.0) || !std::isfinite(length))
      return fmt::format("has a size of {} mm; every size must be more than 0",
                         MmFromMetres(length));
  if (!IsFinite(place.solid_from_part.translation) || !(glm::length(q) > 0.0) ||
      !std::isfinite(glm::length(q)) || !std::isfinite(place.blend) || place.blend < 0.0)
    return "has a place, a turn or a blend that is not a number; type it again";
  if (const auto* box = std::get_if<BoxPart>(&part))
    if (!(box->rounding >= 0.0) ||
        box->rounding > std::min({box->half.x, box->half.y, box->half.z}))
      return fmt::format("has edges with a radius of {} mm, more than half of its least side",
                         MmFromMetres(box->rounding));
  return {};
}

std::string FaultOfLevels(const std::vector<SolidPart>& parts) {
  int level = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const SolidPlace& place = PlaceOf(parts[i]);
    const bool opens = i == 0 || place.level > level;
    if (place.level < 0 || place.level > kDeepestSolidLevel)
      return fmt::format("part {} has level {}; levels go from 0 to {}", i + 1, place.level,
                         kDeepestSolidLevel);
    if (place.level > level + 1 || (i == 0 && place.level != 0))
      return fmt::format("part {} has level {} after {}; a level rises by one at a time", i + 1,
                         place.level, i == 0 ? 0 : level);
    if (i == 0 && opens && place.join != SolidJoin::kUnion)
      return "the first part has nothing to take away from; make it a union";
    level = place.level;
  }
  return {};
}

}  // namespace

SolidPlace& PlaceOf(SolidPart& part) {
  return std::visit([](auto& kind) -> SolidPlace& { return kind.place; }, part);
}
const SolidPlace& PlaceOf(const SolidPart& part) {
  return std::visit([](const auto& kind) -> const SolidPlace& { return kind.place; }, part);
}
const char* TypeOf(const SolidPart& part) {
  return std::visit([](const auto& kind) { return kind.kType; }, part);
}

Solid Scaled(Solid solid, double scale) {
  struct Grow {
    double scale;
    void operator()(EllipsoidPart& p) const { p.radii *= scale; }
    void operator()(CapsulePart& p) const { p.length *= scale, p.radius *= scale; }
    void operator()(TorusPart& p) const { p.ring_radius *= scale, p.tube_radius *= scale; }
    void operator()(BoxPart& p) const { p.half *= scale, p.rounding *= scale; }
    void operator()(PlanePart&) const {}
  };
  for (SolidPart& part : solid.parts) {
    std::visit(Grow{scale}, part);
    PlaceOf(part).blend *= scale;
    PlaceOf(part).solid_from_part.translation *= scale;
  }
  return solid;
}

std::string FaultOfSolid(const Solid& solid) {
  if (solid.parts.empty()) return "the solid has no part; add one";
  if (static_cast<int>(solid.parts.size()) > kMostSolidParts)
    return fmt::format("the solid has {} parts and may have {}; make two solids of it",
                       solid.parts.size(), kMostSolidParts);
  for (std::size_t i = 0; i < solid.parts.size(); ++i)
    if (const std::string fault = FaultOfPart(solid.parts[i]); !fault.empty())
      return fmt::format("part {} ({}) {}", i + 1, TypeOf(solid.parts[i]), fault);
  if (std::string fault = FaultOfLevels(solid.parts); !fault.empty()) return fault;
  const Box3 box = BoundsOfSolid(solid);
  if (box.empty()) return "nothing is left of the solid: its parts do not meet where they must";
  const glm::dvec3 size = box.high - box.low;
  const double largest = std::max({size.x, size.y, size.z});
  if (!std::isfinite(largest))
    return "the solid is inside out or has no end; intersect the plane with a part that has a size";
  if (largest > kLargestSolid)
    return fmt::format("the solid is {:.0f} mm large, more than a joint; are its sizes in metres?",
                       MmFromMetres(largest));
  return {};
}

}  // namespace arthro

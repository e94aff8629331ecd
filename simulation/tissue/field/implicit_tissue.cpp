#include "simulation/tissue/field/implicit_tissue.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

#include "simulation/core/error.h"

namespace arthro::simulation {

namespace {

// Bound of the interpolation's slope: neighbouring values differ by at most their distance, so it
// is at most 1 along each axis.
const double kSteepest = std::sqrt(3.0);
// Contact distance in spacings: 0.35 nm at a spacing of 0.35 mm.
constexpr double kTouch = 1e-6;
// Advance of a ball that touches without approaching, in spacings.
constexpr double kCreep = 0.05;
// Limit below which a motion counts as parallel and does not approach (as in SurfaceBvh).
constexpr double kParallel = 1e-9;
constexpr int kMaxSteps = 1000;

}  // namespace

glm::dvec3 PosedField::ToField(const glm::dvec3& x) const noexcept {
  return glm::conjugate(portal_from_field.quaternion) * (x - portal_from_field.position) /
         portal_from_field.scale;
}

double PosedField::Distance(const glm::dvec3& x) const noexcept {
  return portal_from_field.scale * field.Distance(ToField(x));
}

glm::dvec3 PosedField::Normal(const glm::dvec3& x) const noexcept {
  return portal_from_field.quaternion * NormalInField(ToField(x));
}

glm::dvec3 PosedField::NormalInField(const glm::dvec3& at) const noexcept {
  const double step = 0.5 * field.spacing();
  glm::dvec3 slope;
  for (int a = 0; a < 3; ++a) {
    glm::dvec3 low = at, high = at;
    low[a] -= step;
    high[a] += step;
    slope[a] = field.Distance(high) - field.Distance(low);
  }
  const double steepness = glm::length(slope);
  if (!(steepness > 0.0) || !std::isfinite(steepness)) return {0, 0, 1};
  return slope / steepness;
}

bool PosedField::Sweep(const glm::dvec3& from, const glm::dvec3& to, double radius,
                       FieldHit& hit) const noexcept {
  const glm::dvec3 motion = to - from;
  const double length = glm::length(motion);
  if (!(length > 0.0) || !std::isfinite(length) || field.values().empty()) return false;
  const double spacing = portal_from_field.scale * field.spacing(), end = hit.fraction * length;
  const double band = portal_from_field.scale * field.band();
  double way = 0.0;
  for (int step = 0; step < kMaxSteps && way < end; ++step) {
    const glm::dvec3 x = from + way / length * motion;
    const double distance = Distance(x), gap = distance - radius;
    if (gap > kTouch * spacing) {
      // A distance clamped to the band is still a lower bound.
      way += std::max(gap / kSteepest, 0.5 * kTouch * spacing);
      continue;
    }
    const glm::dvec3 normal = Normal(x);
    if (glm::dot(normal, motion) < -kParallel * length) {
      hit.fraction = way / length;
      hit.normal = normal;
      hit.gap = way > 0.0 ? 0.0 : std::max(-band, std::min(0.0, gap));
      return true;
    }
    way += std::max(kCreep * spacing, -0.5 * gap);
  }
  if (way >= end) return false;
  hit.fraction = way / length;
  hit.normal = Normal(from + way / length * motion);
  hit.gap = 0.0;
  return true;
}

ImplicitTissue::ImplicitTissue(SolidField field, const Pose& portal_from_field)
    : solid_{std::move(field), portal_from_field} {
  if (!(portal_from_field.scale > 0.0) || !std::isfinite(portal_from_field.scale))
    throw Error(Code::kBadArgument, "an implicit tissue's scale must be positive");
  skin_.Update(solid_.field);
}

FieldEdit ImplicitTissue::Subtract(const glm::dvec3& centre, double radius,
                                   const std::function<double(const glm::dvec3&)>& distance) {
  const Pose& pose = solid_.portal_from_field;
  const glm::dvec3 at = solid_.ToField(centre), around(radius / pose.scale);
  return solid_.field.Subtract({at - around, at + around}, [&](const glm::dvec3& x) {
    return distance(pose * x) / pose.scale;
  });
}

FieldEdit ImplicitTissue::Add(const glm::dvec3& centre, double radius,
                              const std::function<double(const glm::dvec3&)>& distance) {
  const Pose& pose = solid_.portal_from_field;
  const glm::dvec3 at = solid_.ToField(centre), around(radius / pose.scale);
  return solid_.field.Add({at - around, at + around},
                          [&](const glm::dvec3& x) { return distance(pose * x) / pose.scale; });
}

}  // namespace arthro::simulation

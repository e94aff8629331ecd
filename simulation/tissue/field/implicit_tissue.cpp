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
  if (field.values().empty()) return false;
  // A distance clamped to the band is still a lower bound.
  const double spacing = portal_from_field.scale * field.spacing();
  const double band = portal_from_field.scale * field.band();
  return SweepBall([&](const glm::dvec3& x) { return Distance(x); },
                   [&](const glm::dvec3& x) { return Normal(x); },
                   {kTouch * spacing, kCreep * spacing, kSteepest, band}, from, to, radius, hit);
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

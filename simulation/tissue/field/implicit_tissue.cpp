#include "simulation/tissue/field/implicit_tissue.h"

#include <cmath>
#include <utility>

#include "simulation/core/error.h"

namespace arthro::simulation {

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

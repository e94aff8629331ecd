// A solid field where it stands among the tools: a ball is swept against it as against a mesh.
// Portal frame, m. Noexcept, allocates nothing.
#pragma once

#include <glm/vec3.hpp>

#include "simulation/core/frames.h"
#include "simulation/tissue/field/solid_field.h"

namespace arthro::simulation {

// As SweepHit of a mesh.
struct FieldHit {
  double fraction = 1;         // of the way, 0..1, where the ball touches
  glm::dvec3 normal{0, 0, 1};  // unit, from the surface to the ball's centre
  double gap = 0;              // m, negative where the ball was in the surface at the start
};

struct PosedField {
  SolidField field;
  Pose portal_from_field;  // scale above 0

  // Does a ball going from `from` to `to` meet the surface? `hit` is changed only for a meeting
  // earlier than hit.fraction; what leaves is let pass. Steps are no longer than the field says is
  // free, so nothing is tunnelled through; a way that grazes so long that it runs out of steps ends
  // there. Where edits left a crease the field gives a bound and the ball is held off a little.
  bool Sweep(const glm::dvec3& from, const glm::dvec3& to, double radius,
             FieldHit& hit) const noexcept;
  double Distance(const glm::dvec3& x) const noexcept;  // m, negative inside
  // Unit, outwards; from differences over a spacing, so that it turns without steps between cells.
  glm::dvec3 Normal(const glm::dvec3& x) const noexcept;

  // The field's own frame.
  glm::dvec3 ToField(const glm::dvec3& x) const noexcept;
  glm::dvec3 NormalInField(const glm::dvec3& x) const noexcept;
};

}  // namespace arthro::simulation

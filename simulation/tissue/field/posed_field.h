// Solid field at its pose in the portal frame, against which a ball is swept as against a mesh.
// Portal frame, m. Noexcept, allocates nothing.
#pragma once

#include <glm/vec3.hpp>

#include "simulation/core/frames.h"
#include "simulation/tissue/field/solid_field.h"

namespace arthro::simulation {

// Contact of a swept ball, as SweepHit of a mesh.
struct FieldHit {
  double fraction = 1;         // fraction of the path, 0..1, at which the ball touches
  glm::dvec3 normal{0, 0, 1};  // unit, from the surface to the ball's centre
  double gap = 0;              // m, negative if the ball penetrated the surface at the start
};

struct PosedField {
  SolidField field;
  Pose portal_from_field;  // scale above 0

  // Returns whether a ball moving from `from` to `to` meets the surface. Changes `hit` only for a
  // contact earlier than hit.fraction; a separating motion passes. Steps are no longer than the
  // field's free distance, so the ball cannot tunnel. A grazing path that uses up its steps ends
  // there. At a crease left by edits the field is a lower bound, so the ball stops slightly early.
  bool Sweep(const glm::dvec3& from, const glm::dvec3& to, double radius,
             FieldHit& hit) const noexcept;
  double Distance(const glm::dvec3& x) const noexcept;  // m, negative inside
  // Returns the unit outward normal, from differences over one spacing, so that it varies smoothly
  // between cells.
  glm::dvec3 Normal(const glm::dvec3& x) const noexcept;

  // Field's frame.
  glm::dvec3 ToField(const glm::dvec3& x) const noexcept;
  glm::dvec3 NormalInField(const glm::dvec3& x) const noexcept;
};

}  // namespace arthro::simulation

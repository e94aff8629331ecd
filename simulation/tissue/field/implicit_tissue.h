// Tissue that is a function of space: a loose body, a synovial tuft [paper, 3.4]. A field with a
// pose that tools take from and add to, that a ball is swept against as against a mesh, and that is
// made triangles of only where it changed. Portal frame, m. Sweep is noexcept, allocates nothing.
#pragma once

#include <functional>

#include <glm/vec3.hpp>

#include "simulation/core/frames.h"
#include "simulation/tissue/field/polygonise.h"
#include "simulation/tissue/field/solid_field.h"

namespace arthro::simulation {

// As SweepHit of a mesh.
struct FieldHit {
  double fraction = 1;         // of the way, 0..1, where the ball touches
  glm::dvec3 normal{0, 0, 1};  // unit, from the surface to the ball's centre
  double gap = 0;              // m, negative where the ball was in the surface at the start
};

class ImplicitTissue {
 public:
  ImplicitTissue(SolidField field, const Pose& portal_from_field);

  // Does a ball going from `from` to `to` meet the surface? `hit` is changed only for a meeting
  // earlier than hit.fraction; what leaves is let pass. Steps are no longer than the field says is
  // free, so nothing is tunnelled through; a way that grazes so long that it runs out of steps ends
  // there. Where edits left a crease the field gives a bound and the ball is held off a little.
  bool Sweep(const glm::dvec3& from, const glm::dvec3& to, double radius,
             FieldHit& hit) const noexcept;
  double Distance(const glm::dvec3& x) const noexcept;  // m, negative inside
  // Unit, outwards; from differences over a spacing, so that it turns without steps between cells.
  glm::dvec3 Normal(const glm::dvec3& x) const noexcept;

  // Boolean edits by a distance in the portal frame, within a ball there.
  FieldEdit Subtract(const glm::dvec3& centre, double radius,
                     const std::function<double(const glm::dvec3&)>& distance);
  FieldEdit Add(const glm::dvec3& centre, double radius,
                const std::function<double(const glm::dvec3&)>& distance);
  SkinUpdate UpdateSkin() { return skin_.Update(field_); }

  const FieldSkin& skin() const { return skin_; }  // field's own frame
  const SolidField& field() const { return field_; }
  const Pose& portal_from_field() const { return pose_; }

 private:
  glm::dvec3 ToField(const glm::dvec3& x) const noexcept;

  SolidField field_;
  Pose pose_;
  FieldSkin skin_;
};

}  // namespace arthro::simulation

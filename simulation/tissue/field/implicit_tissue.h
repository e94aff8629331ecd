// Tissue defined by an implicit function: a loose body, a synovial tuft [paper, 3.4]. Holds a field
// with a pose, which tools cut and add to, and a skin whose triangles are rebuilt only where the
// field changed. Portal frame, m.
#pragma once

#include <functional>

#include <glm/vec3.hpp>

#include "simulation/core/frames.h"
#include "simulation/scene/mesh/ball_sweep.h"
#include "simulation/tissue/field/polygonise.h"
#include "simulation/tissue/field/solid_field.h"

namespace arthro::simulation {

using FieldHit = BallHit;

// Solid field at its pose in the portal frame, against which a ball is swept as against a mesh.
// Noexcept, allocates nothing.
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

class ImplicitTissue {
 public:
  ImplicitTissue(SolidField field, const Pose& portal_from_field);

  bool Sweep(const glm::dvec3& from, const glm::dvec3& to, double radius,
             FieldHit& hit) const noexcept {
    return solid_.Sweep(from, to, radius, hit);
  }
  double Distance(const glm::dvec3& x) const noexcept { return solid_.Distance(x); }

  // Edit the field by a distance in the portal frame, within a ball in that frame.
  FieldEdit Subtract(const glm::dvec3& centre, double radius,
                     const std::function<double(const glm::dvec3&)>& distance);
  FieldEdit Add(const glm::dvec3& centre, double radius,
                const std::function<double(const glm::dvec3&)>& distance);
  SolidField& field_to_edit() { return solid_.field; }  // in the field's frame
  SkinUpdate UpdateSkin() { return skin_.Update(solid_.field); }

  const PosedField& solid() const { return solid_; }
  const SolidField& field() const { return solid_.field; }
  const FieldSkin& skin() const { return skin_; }  // in the field's frame
  const Pose& portal_from_field() const { return solid_.portal_from_field; }

 private:
  PosedField solid_;
  FieldSkin skin_;
};

}  // namespace arthro::simulation

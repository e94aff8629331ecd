// Surface of an implicit-function tissue [paper, 3.4], swept by the servo: its function as long as
// nothing was cut from it, and then the field that stores the cuts. Portal frame, m.
#pragma once

#include <memory>
#include <utility>

#include <glm/gtc/quaternion.hpp>

#include "simulation/core/frames.h"
#include "simulation/haptics/surface/swept_surface.h"
#include "simulation/scene/solids/solid_function.h"
#include "simulation/tissue/field/implicit_tissue.h"

namespace arthro::simulation {

// A function of the scene, at its pose.
struct PosedFunction {
  std::shared_ptr<const SolidFunction> function;
  Rigid3 portal_from_solid;

  double Distance(const glm::dvec3& x) const noexcept { return function->Value(ToSolid(x)); }
  glm::dvec3 Normal(const glm::dvec3& x) const noexcept {
    return portal_from_solid.rotation * function->Normal(ToSolid(x));
  }
  glm::dvec3 ToSolid(const glm::dvec3& x) const noexcept {
    return glm::conjugate(portal_from_solid.rotation) * (x - portal_from_solid.translation);
  }
  bool Sweep(const glm::dvec3& from, const glm::dvec3& to, double radius,
             BallHit& hit) const noexcept {
    constexpr double kTouch = 1e-10;   // m
    constexpr double kCreep = 2e-5;    // m
    constexpr double kDeepest = 5e-3;  // m, as of a field with a spacing of 0.35 mm
    return SweepBall([&](const glm::dvec3& x) { return Distance(x); },
                     [&](const glm::dvec3& x) { return Normal(x); },
                     {kTouch, kCreep, 1.0, kDeepest}, from, to, radius, hit);
  }
};

class FieldSurface : public SweptSurface {
 public:
  // Refers to `solid`, which must be constant while it is touched and must outlive this.
  explicit FieldSurface(const PosedField& solid) : now_(&solid) {}
  // Touches `function` while `solid`, which was sampled from it, is whole.
  FieldSurface(const PosedField& solid, PosedFunction function)
      : function_(std::move(function)), now_(&solid) {}
  // Shares the tissue with the picture.
  explicit FieldSurface(std::shared_ptr<const ImplicitTissue> tissue)
      : kept_(std::move(tissue)), now_(&kept_->solid()) {}
  // Replaces the solid; call between ticks.
  void Become(const PosedField& solid) noexcept { now_ = &solid; }
  bool Sweep(const glm::dvec3& from, const glm::dvec3& to, double radius, int /*first*/,
             SweepHit& hit) const noexcept override {
    BallHit met;
    met.fraction = hit.fraction;
    if (!(IsWhole() ? function_.Sweep(from, to, radius, met) : now_->Sweep(from, to, radius, met)))
      return false;
    hit = {met.fraction, met.normal, met.gap, -1};
    return true;
  }
  bool IsFree(const glm::dvec3& x, double radius) const noexcept override {
    return (IsWhole() ? function_.Distance(x) : now_->Distance(x)) >= radius;
  }

 private:
  // True while the function is the surface: nothing was cut from its samples.
  bool IsWhole() const noexcept {
    return function_.function != nullptr && now_->field.cut_values().empty();
  }

  PosedFunction function_;
  std::shared_ptr<const ImplicitTissue> kept_;
  const PosedField* now_;
};

}  // namespace arthro::simulation

// Surface of an implicit-function tissue [paper, 3.4], swept by the servo. Portal frame, m.
#pragma once

#include <memory>
#include <utility>

#include "simulation/haptics/surface/swept_surface.h"
#include "simulation/tissue/field/implicit_tissue.h"

namespace arthro::simulation {

class FieldSurface : public SweptSurface {
 public:
  // Refers to `solid`, which must be constant while it is touched and must outlive this.
  explicit FieldSurface(const PosedField& solid) : now_(&solid) {}
  // Shares the tissue with the picture.
  explicit FieldSurface(std::shared_ptr<const ImplicitTissue> tissue)
      : kept_(std::move(tissue)), now_(&kept_->solid()) {}
  // Replaces the solid; call between ticks.
  void Become(const PosedField& solid) noexcept { now_ = &solid; }
  bool Sweep(const glm::dvec3& from, const glm::dvec3& to, double radius, int /*first*/,
             SweepHit& hit) const noexcept override {
    FieldHit met;
    met.fraction = hit.fraction;
    if (!now_->Sweep(from, to, radius, met)) return false;
    hit = {met.fraction, met.normal, met.gap, -1};
    return true;
  }
  bool IsFree(const glm::dvec3& x, double radius) const noexcept override {
    return now_->Distance(x) >= radius;
  }

 private:
  std::shared_ptr<const ImplicitTissue> kept_;
  const PosedField* now_;
};

}  // namespace arthro::simulation

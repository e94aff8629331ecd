// An implicit-function tissue [paper 3.4] as the servo bumps into it. Portal frame, m.
#pragma once

#include <memory>
#include <utility>

#include "simulation/haptics/swept_surface.h"
#include "simulation/tissue/field/implicit_tissue.h"

namespace arthro::simulation {

class FieldSurface : public SweptSurface {
 public:
  // Shared with who draws and edits it; nobody changes it while it is touched.
  explicit FieldSurface(std::shared_ptr<const ImplicitTissue> tissue)
      : tissue_(std::move(tissue)) {}
  bool Sweep(const glm::dvec3& from, const glm::dvec3& to, double radius, int /*first*/,
             SweepHit& hit) const noexcept override {
    FieldHit met;
    met.fraction = hit.fraction;
    if (!tissue_->Sweep(from, to, radius, met)) return false;
    hit = {met.fraction, met.normal, met.gap, -1};
    return true;
  }

 private:
  std::shared_ptr<const ImplicitTissue> tissue_;
};

}  // namespace arthro::simulation

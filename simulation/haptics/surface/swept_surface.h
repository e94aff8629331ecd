// Contact with a surface that is no triangle mesh: sweeps a ball along a segment to its first
// contact, as SurfaceBvh does. It replaces a mesh in Surroundings. Portal frame, m; noexcept,
// allocates nothing.
#pragma once

#include <glm/vec3.hpp>

#include "simulation/haptics/surface/surface_bvh.h"

namespace arthro::simulation {

class SweptSurface {
 public:
  virtual ~SweptSurface() = default;
  // Sweeps a ball as SurfaceBvh::Sweep does: changes `hit` only for a contact earlier than
  // hit.fraction, stops motion from outside and lets motion from inside pass. `first` is the
  // hit.triangle of the last contact, −1 if there is none; it may be ignored.
  virtual bool Sweep(const glm::dvec3& from, const glm::dvec3& to, double radius, int first,
                     SweepHit& hit) const noexcept = 0;
  // Returns false where the surface, after a change, covers a ball at `x`.
  virtual bool IsFree(const glm::dvec3& x, double radius) const noexcept = 0;
};

}  // namespace arthro::simulation

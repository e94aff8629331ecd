// A surface that is no triangle mesh as something to bump into, as SurfaceBvh: a ball is swept
// along a segment and stops where it first meets it. Surroundings hold it in the place of a mesh.
// Portal frame, m; noexcept, allocates nothing.
#pragma once

#include <glm/vec3.hpp>

#include "simulation/haptics/surface_bvh.h"

namespace arthro::simulation {

class SweptSurface {
 public:
  virtual ~SweptSurface() = default;
  // As SurfaceBvh::Sweep: `hit` is changed only for a meeting earlier than hit.fraction, what comes
  // from outside is stopped and what leaves is let pass. `first` is the hit.triangle of the last
  // meeting, −1 if there is none; it may be ignored.
  virtual bool Sweep(const glm::dvec3& from, const glm::dvec3& to, double radius, int first,
                     SweepHit& hit) const noexcept = 0;
  // False where a change of the surface has come to lie over a ball there.
  virtual bool IsFree(const glm::dvec3& x, double radius) const noexcept = 0;
};

}  // namespace arthro::simulation

// Proxy of a tip: its position if surfaces could not be entered. One proxy serves the backdrop and
// all meshes, in the intersection of their free spaces, so no force is counted twice or jumps where
// one surface ends in front of another [paper, 3.4; Zilles & Salisbury 1995; Ruspini et al. 1997].
// It moves to the nearest free point by descent only. Along the backdrop it takes steps of one
// pixel that are re-projected, and accepted only if they come nearer to the tip; along meshes it
// sweeps. It therefore neither jumps through a cliff nor tunnels. Portal frame, m; noexcept,
// allocates nothing.
#pragma once

#include <span>

#include "simulation/haptics/planes.h"
#include "simulation/haptics/relief/depth_field.h"
#include "simulation/haptics/surface/surface_bvh.h"
#include "simulation/haptics/surface/swept_surface.h"

namespace arthro::simulation {

// Surfaces in reach. Contact 0 is the field, 1 + i is mesh i.
struct Surroundings {
  const DepthField& field;
  std::span<const SurfaceBvh> meshes;
  // Substitutes, at most one per mesh; null: the mesh itself.
  std::span<const SweptSurface* const> instead = {};
};

// Centre of a ball that stays at least `radius` from all surfaces.
struct Proxy {
  glm::dvec3 position{0.0};
  int last_mesh = -1, last_triangle = -1;  // contact of the last sweep, tried first in the next
};

// Moves the proxy towards `goal` as far as the surfaces allow. It travels at most `max_travel`, so
// that a surface that appears, or an edge that it slips off, does not throw it. Only a proxy that
// `is_free` (at its tip without contact) moves without limit until it meets a surface.
void MoveProxy(const Surroundings& surroundings, double radius, const glm::dvec3& goal,
               double max_travel, bool is_free, Proxy& proxy) noexcept;

// Returns false where a surface now covers the proxy, as after a change of an implicit tissue.
bool IsFree(const Surroundings& surroundings, double radius, const Proxy& proxy) noexcept;

// Returns true where a ball moves straight from `from` to `to` without contact. From the portal of
// a tool, this is the path of its rod.
bool IsWayFree(const Surroundings& surroundings, double radius, const glm::dvec3& from,
               const glm::dvec3& to) noexcept;

// Returns the planes that hold the proxy while it is pulled to `goal`.
PlaneSet PlanesAt(const Surroundings& surroundings, double radius, const glm::dvec3& goal,
                  Proxy& proxy) noexcept;

}  // namespace arthro::simulation

// The proxy: the place where the tip would be if surfaces could not be entered. One proxy for the
// backdrop and all meshes together, in the intersection of their free spaces, so nothing is counted
// twice and nothing steps where one ends in front of the other [paper, 3.4; Zilles & Salisbury
// 1995; Ruspini et al. 1997]. It moves to the nearest free point by descent only: along the
// backdrop in steps of one pixel that are re-projected and taken only if they come nearer to the
// tip, along meshes by sweeps. It therefore neither pops through a cliff nor tunnels. Portal frame,
// m; noexcept, allocates nothing.
#pragma once

#include <span>

#include "simulation/haptics/depth_field.h"
#include "simulation/haptics/planes.h"
#include "simulation/haptics/surface_bvh.h"
#include "simulation/haptics/swept_surface.h"

namespace arthro::simulation {

// What can be touched. Contact 0 is the field, 1 + i is mesh i.
struct Surroundings {
  const DepthField& field;
  std::span<const SurfaceBvh> meshes;
  // One a mesh, or fewer: what is touched in its place; null: the mesh.
  std::span<const SweptSurface* const> instead = {};
};

// A ball's centre that stays at least `radius` from all surfaces.
struct Proxy {
  glm::dvec3 position{0.0};
  int last_mesh = -1, last_triangle = -1;  // met last; tried first
};

// Towards `goal`, as far as the surfaces let it. It travels at most `max_travel`, so that a surface
// that appears, or an edge that it slips off, does not throw it; only a proxy that `is_free`, at
// its tip with nothing touched, flies without limit until it meets something.
void MoveProxy(const Surroundings& surroundings, double radius, const glm::dvec3& goal,
               double max_travel, bool is_free, Proxy& proxy) noexcept;

// False where a surface has come to lie over the proxy, as after a change of the depth map or of a
// tissue that is a function.
bool IsFree(const Surroundings& surroundings, double radius, const Proxy& proxy) noexcept;

// True where a ball that comes straight from `from` reaches `to` and touches nothing on the way.
// From a tool's portal this is the rod itself: what crosses no surface is held by none.
bool IsWayFree(const Surroundings& surroundings, double radius, const glm::dvec3& from,
               const glm::dvec3& to) noexcept;

// The planes that hold the proxy where it is when it is drawn to `goal`.
PlaneSet PlanesAt(const Surroundings& surroundings, double radius, const glm::dvec3& goal,
                  Proxy& proxy) noexcept;

}  // namespace arthro::simulation

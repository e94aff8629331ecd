// Mesh simplification: a scan has far more triangles than a solver can use between two frames.
#pragma once

#include <functional>

#include <glm/vec3.hpp>

#include "simulation/core/progress.h"
#include "simulation/scene/mesh/surface_mesh.h"

namespace arthro::authoring {

struct Simplification {
  int triangles_before = 0, triangles_after = 0;
  double largest_distance = 0;  // m, from a removed vertex to the simplified surface
};

// Collapses edges in the order of their quadric error (Garland and Heckbert 1997) until at most
// `most_triangles` are left, or no edge can be collapsed without folding the surface. Remaining
// vertices do not move. The surface must be a manifold.
Simplification SimplifySurface(SurfaceMesh& surface, int most_triangles,
                               const Progress& progress = {});

// Simplifies a surface for few large elements: long edges count as error too, so that triangles
// stay even. `weight` multiplies the error at a place, so that triangles are smaller where it is
// large.
Simplification SimplifyEvenly(SurfaceMesh& surface, int most_triangles,
                              const std::function<double(const glm::dvec3&)>& weight,
                              const Progress& progress = {});

}  // namespace arthro::authoring

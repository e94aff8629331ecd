// Fewer triangles for the same shape: a scan has far more than a solver can use between two frames.
#pragma once

#include <functional>

#include <glm/vec3.hpp>

#include "simulation/core/progress.h"
#include "simulation/scene/surface_mesh.h"

namespace arthro::authoring {

struct Simplification {
  int triangles_before = 0, triangles_after = 0;
  double largest_distance = 0;  // m, of a vertex that went from the surface that is left
};

// Collapses edges in the order of their quadric error (Garland and Heckbert 1997) until at most
// `most_triangles` are left, or until no edge can go without folding the surface. The vertices that
// stay are not moved. The surface must be a manifold.
Simplification SimplifySurface(SurfaceMesh& surface, int most_triangles,
                               const Progress& progress = {});

// The same for a surface that is to be filled with few large elements: long edges count as error
// too, so that triangles stay even, and all of it counts `weight` times as much at a place, so that
// triangles are smaller where it is large.
Simplification SimplifyEvenly(SurfaceMesh& surface, int most_triangles,
                              const std::function<double(const glm::dvec3&)>& weight,
                              const Progress& progress = {});

// The place of the surface nearest to x.
glm::dvec3 NearestOnSurface(const glm::dvec3& x, const SurfaceMesh& surface);

// Distance of a point from a triangle.
double DistanceToTriangle(const glm::dvec3& x, const glm::dvec3& a, const glm::dvec3& b,
                          const glm::dvec3& c);

}  // namespace arthro::authoring

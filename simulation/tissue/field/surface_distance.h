// Signed distances of grid nodes to a closed triangle surface, negative inside. m.
#pragma once

#include <vector>

#include "simulation/scene/mesh/surface_mesh.h"
#include "simulation/tissue/field/solid_field.h"

namespace arthro::simulation {

// Computes the distances: exact within two spacings of the surface. Further off only the nearest
// triangles of neighbouring nodes are tried. The error is largest where many triangles are about
// equally near: 0.09 mm at the core of a ring 6 mm thick with a spacing of 0.35 mm.
// The sign comes from the winding number along each of the three axes by a vote of two out of
// three, so overlapping parts form a union. Throws Error(kBadMesh) for a surface that is empty,
// open or not finite.
std::vector<float> SignedDistances(const SurfaceMesh& surface, const FieldGrid& grid, double band);

}  // namespace arthro::simulation

// Signed distances of grid nodes to a closed triangle surface, negative inside. m.
#pragma once

#include <vector>

#include "simulation/scene/surface_mesh.h"
#include "simulation/tissue/field/solid_field.h"

namespace arthro::simulation {

// Exact within two spacings of the surface. Further off the distance is to the nearest of the
// triangles that are nearest to the node's neighbours, which errs where many are about as near: at
// the core of a ring 6 mm thick by 0.09 mm with a spacing of 0.35 mm. Sides are told by how often
// the surface winds about a node, along all three axes, two of three deciding: overlapping parts
// are a union. Throws Error(kBadMesh) for a surface that is empty, open or not finite.
std::vector<float> SignedDistances(const SurfaceMesh& surface, const FieldGrid& grid, double band);

}  // namespace arthro::simulation

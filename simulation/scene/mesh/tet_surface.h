// Outer surface of a tetrahedral volume, as a surface of its own.
#pragma once

#include "simulation/scene/mesh/surface_mesh.h"
#include "simulation/scene/mesh/tet_mesh.h"

namespace arthro {

// Triangles of the faces that belong to one element only, facing outwards; four per curved face.
// Vertices are the nodes on them, in the order of the nodes.
SurfaceMesh SurfaceOf(const TetMesh& mesh);

}  // namespace arthro

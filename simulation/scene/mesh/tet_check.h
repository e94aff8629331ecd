// Checks of a tetrahedral mesh before it is solved. Repairs faults that have one right answer,
// reports the repairs, and refuses all other faults.
#pragma once

#include <filesystem>

#include "simulation/scene/mesh/mesh_io.h"
#include "simulation/scene/mesh/tet_mesh.h"

namespace arthro {

// Volume over the cube of the longest edge of element i's corners, signed; a regular one has 0.118.
double RelativeVolume(const TetMesh& mesh, int element);

// Turns elements listed inside out, merges nodes that lie exactly on one another, drops elements
// that are there twice and nodes of no element; warns of slivers. Throws Error(kBadMesh) for
// coordinates that are not finite and for elements without volume.
void CheckAndRepair(TetMesh& mesh, const std::filesystem::path& file, TetReadReport* report);

}  // namespace arthro

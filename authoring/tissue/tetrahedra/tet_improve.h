// Raises the smallest dihedral angles of a tetrahedral mesh: an element that is nearly flat makes
// the stiffness matrix ill-conditioned. Removes edges by the best triangulation of their ring
// [Klincsek 1980; Shewchuk 2002], flips faces, collapses edges and moves nodes, each only where the
// smallest angle of the changed elements grows [Freitag & Ollivier-Gooch 1997].
#pragma once

#include "simulation/core/progress.h"
#include "simulation/scene/mesh/surface_mesh.h"
#include "simulation/scene/mesh/tet_mesh.h"

namespace arthro::authoring {

struct TetImprovement {
  double before = 0, after = 0;  // rad, smallest dihedral angle
  int edges_removed = 0, faces_flipped = 0, edges_collapsed = 0, nodes_moved = 0;
};

// Works until no dihedral angle is below `goal` (rad), or nothing helps. Nodes on the boundary move
// along `fine`; no edge of the boundary gets farther from it than the farthest one was. Edges
// become straight, and nodes are numbered anew; the set "surface" is made again, others are
// dropped.
TetImprovement ImproveTets(TetMesh& mesh, const SurfaceMesh& fine, double goal,
                           const Progress& progress = {});

}  // namespace arthro::authoring

// Curved quadratic elements: moves the middles of outer edges onto the fine surface that the
// corners were taken from, so that few elements keep its shape and volume. m.
#pragma once

#include "simulation/core/progress.h"
#include "simulation/scene/mesh/surface_mesh.h"
#include "simulation/scene/mesh/tet_mesh.h"

namespace arthro::authoring {

// Least JacobianShare (tet_quality.h) of an element; a middle moves only as far as this allows.
inline constexpr double kLeastJacobian = 0.3;

struct PulledMiddles {
  int pulled = 0, held_back = 0;  // middles that moved completely, and the others
  double largest_move = 0;        // m
};

// The mesh has order 2 and straight edges.
PulledMiddles PullMiddles(TetMesh& mesh, const SurfaceMesh& fine, const Progress& progress = {});

}  // namespace arthro::authoring

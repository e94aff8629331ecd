// Curved quadratic elements: the middles of edges on the outside go onto the fine surface that the
// corners were taken from, so that few elements keep its shape and volume. m.
#pragma once

#include "simulation/core/progress.h"
#include "simulation/scene/surface_mesh.h"
#include "simulation/scene/tet_mesh.h"

namespace arthro::authoring {

// No element's JacobianShare (tet_quality.h) falls below this; a middle goes only as far as that.
inline constexpr double kLeastJacobian = 0.3;

struct PulledMiddles {
  int pulled = 0, held_back = 0;  // all the way or not
  double largest_move = 0;        // m
};

// Of an order-2 mesh with straight edges.
PulledMiddles PullMiddles(TetMesh& mesh, const SurfaceMesh& fine, const Progress& progress = {});

}  // namespace arthro::authoring

// What can be mended without guessing: vertices that are one, triangles that say nothing, sides
// that face the wrong way. Holes and debris are only touched when asked for. Each change is
// counted; what is left wrong is for surface_check.h to name.
#pragma once

#include <vector>

#include "simulation/core/progress.h"
#include "simulation/scene/surface_mesh.h"

namespace arthro::authoring {

struct SurfaceRepairOptions {
  int fill_holes = 0;             // edges; holes of at most so many sides are closed
  double drop_below_share = 0.0;  // components with a smaller share of the whole volume are dropped
};

struct SurfaceRepairs {
  int welded_vertices = 0;        // nearer to another one than kWeldShare of the diagonal
  int collapsed_triangles = 0;    // two corners on one point after welding
  int duplicate_triangles = 0;    // dropped
  int flattened_triangles = 0;    // without area: their long side was turned into the neighbour
  int unreferenced_vertices = 0;  // dropped
  int filled_holes = 0;           // with as many triangles as they have sides, less two
  int reoriented_triangles = 0;   // turned to face as their neighbours do
  int flipped_components = 0;     // turned to face outwards
  int dropped_components = 0;     // too small

  int Total() const {
    return welded_vertices + collapsed_triangles + duplicate_triangles + flattened_triangles +
           unreferenced_vertices + filled_holes + reoriented_triangles + flipped_components +
           dropped_components;
  }
};

struct RepairedSurface {
  SurfaceMesh surface;
  // Of each triangle: its number in the surface that came in; -1 for one that fills a hole.
  std::vector<int> source_triangle;
  SurfaceRepairs repairs;
};

inline constexpr double kWeldShare = 1e-6;  // of the bounding box's diagonal

RepairedSurface RepairSurface(const SurfaceMesh& surface, const SurfaceRepairOptions& options,
                              const Progress& progress = {});

}  // namespace arthro::authoring

// Repairs that need no guess: welds equal vertices, drops degenerate triangles, turns triangles
// that face the wrong way. Fills holes and drops debris only on request. Counts each change;
// remaining faults are reported by surface_check.h.
#pragma once

#include <vector>

#include "simulation/core/progress.h"
#include "simulation/scene/mesh/surface_mesh.h"

namespace arthro::authoring {

struct SurfaceRepairOptions {
  int fill_holes = 0;             // sides; larger holes stay open
  double drop_below_share = 0.0;  // share of the whole volume; smaller components are dropped
};

struct SurfaceRepairs {
  int welded_vertices = 0;        // nearer to another one than kWeldShare of the diagonal
  int collapsed_triangles = 0;    // two corners on one point after welding
  int duplicate_triangles = 0;    // dropped
  int flattened_triangles = 0;    // without area: their long side was flipped into the neighbour
  int unreferenced_vertices = 0;  // dropped
  int filled_holes = 0;           // each with two triangles fewer than it has sides
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
  // Per triangle, its number in the input surface; -1 for one that fills a hole.
  std::vector<int> source_triangle;
  SurfaceRepairs repairs;
};

inline constexpr double kWeldShare = 1e-6;  // share of the bounding box's diagonal

RepairedSurface RepairSurface(const SurfaceMesh& surface, const SurfaceRepairOptions& options,
                              const Progress& progress = {});

}  // namespace arthro::authoring

// From a closed surface to a tetrahedral mesh: repairs what is safe, refuses what is not, lets
// TetGen fill the rest in a process of its own, and measures the result. Metres.
#pragma once

#include <chrono>
#include <filesystem>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "authoring/tissue/surface/surface_check.h"
#include "authoring/tissue/surface/surface_repair.h"
#include "authoring/tissue/surface/surface_simplify.h"
#include "authoring/tissue/tetrahedra/tet_improve.h"
#include "authoring/tissue/tetrahedra/tet_quality.h"
#include "simulation/core/options.h"
#include "simulation/core/progress.h"
#include "simulation/scene/mesh/mesh_io.h"
#include "simulation/scene/mesh/surface_mesh.h"
#include "simulation/scene/mesh/tet_mesh.h"
#include "simulation/scene/scene.h"

namespace arthro::authoring {

struct TetrahedralizeOptions {
  int order = 1;
  double max_edge = 0.0;
  std::vector<Ball> fine_at;  // places where fine_edge holds, in the surface's own frame
  double fine_edge = 0.0;
  double min_dihedral = 10.0 * std::numbers::pi / 180.0;
  double radius_edge = 1.4;
  bool keep_surface = false;
  double thickness = 0.0;
  int max_triangles = 0;
  int fill_holes = 0;
  double drop_below = 0.0;
  double time_limit = 120.0;
  // Start of the time limit; not given: the call of Tetrahedralize.
  std::optional<std::chrono::steady_clock::time_point> begun;
  double memory_limit = 2048.0;
  template <class V>
  void Visit(V&& v) {
    v("order", order, Range{1, 2}, "",
      "1: four nodes per element; 2: ten, with the middles of the edges. Ten are far more accurate "
      "for the same number of nodes.");
    v("max_edge", max_edge, Range{0.0, 1.0}, "m",
      "No edge is longer than this; 0: as coarse as the surface allows.");
    v("fine_edge", fine_edge, Range{0.0, 1.0}, "m",
      "No edge is longer than this in elements that reach into a place of --fine-at.");
    v("min_dihedral", min_dihedral, Range{0.0, std::numbers::pi / 10}, "rad",
      "Elements with a smaller dihedral angle are refined where the surface allows it.");
    v("radius_edge", radius_edge, Range{1.1, 10.0}, "",
      "Elements with a larger ratio of circumradius to shortest edge are refined.");
    v("keep_surface", keep_surface, Any{}, "",
      "No node is added on the surface: few elements, as uneven as its triangles.");
    v("thickness", thickness, Range{-0.02, 0.02}, "m",
      "An open sheet, such as a scanned joint surface, becomes a layer of this thickness behind "
      "its triangles (in front of them when negative); 0: it is refused.");
    v("max_triangles", max_triangles, Range{0, 10000000}, "",
      "The surface is simplified to at most this many triangles first, with the least change of "
      "shape; 0: all are kept. Some hundred suit a tissue that is deformed at display rate.");
    v("fill_holes", fill_holes, Range{0, 100}, "",
      "Holes with at most this many sides are closed; 0: an open surface is refused.");
    v("drop_below", drop_below, Range{0.0, 0.5}, "",
      "Separate parts with a smaller share of the whole volume are dropped.");
    v("time_limit", time_limit, Range{0.01, 86400.0}, "s",
      "The whole job is ended after this time, reading and checking the surface included.");
    v("memory_limit", memory_limit, Range{1.0, 1048576.0}, "MB",
      "Memory that the mesher may use at most.");
  }
};

// One run of TetGen and its result, in words.
struct TetgenAttempt {
  std::string switches, result;
};

struct TetrahedralizeReport {
  SurfaceReadReport reading;
  SurfaceRepairs repairs;
  int thickened_parts = 0;
  Simplification simplification;
  SurfaceCheck surface;        // filled surface, after repairs
  TetImprovement improvement;  // in a mesh to a budget
  TetQuality quality;
  int nodes = 0, elements = 0, surface_nodes = 0;
  double volume_error = 0;       // elements against surface, relative
  double longest_fine_edge = 0;  // m, in the places of fine_at
  std::vector<TetgenAttempt> attempts;
  std::vector<std::string> warnings;
  double check_ms = 0, mesh_ms = 0, measure_ms = 0;
};

// Program that contains RunTetgenWorker (tetgen_worker.h): this one, unless a test says otherwise.
inline const std::filesystem::path kThisProgram = "/proc/self/exe";

// The mesh has the surface's vertices first, unmoved, and a set "surface". Throws Error(kBadMesh)
// with one sentence: the fault, its place in the file's unit, and what to do.
TetMesh Tetrahedralize(const SurfaceMesh& surface, const SurfaceSource& source,
                       const TetrahedralizeOptions& options, TetrahedralizeReport* report,
                       const Progress& progress = {},
                       const std::filesystem::path& program = kThisProgram);

// Returns JSON text: arthroscene.tetrahedralize/1.
std::string ReportText(const TetrahedralizeReport& report, const SurfaceSource& source,
                       const TetrahedralizeOptions& options);

}  // namespace arthro::authoring

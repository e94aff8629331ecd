// TetGen in a process of its own: it may crash, abort, run for ever or eat all memory on input that
// it does not like. The parent writes a job into a folder, runs `PROGRAM tetgen-worker FOLDER`, and
// reads the mesh that the worker left there.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "simulation/scene/tet_mesh.h"

namespace arthro::authoring {

// Tetrahedra that reach into the ball have no longer edge than this.
struct FinePlace {
  glm::dvec3 centre{0.0};
  double radius = 0, max_edge = 0;
};

struct TetgenJob {
  std::string switches;       // TetGen's own
  double flat_angle = 180;    // deg; facets that meet at more than this are one plane
  double max_dihedral = 165;  // deg; flatter elements are smoothed at the end
  double max_edge = 0;        // tetrahedra with a longer edge are split; 0: none
  double memory_limit = 0;    // bytes on top of the program itself
  double time_limit = 0;      // s of processor time: the worker's own stop if its parent forgets it
  std::vector<FinePlace> fine;
  std::vector<glm::dvec3> points;
  std::vector<std::array<int, 3>> triangles;
};

// How the worker ends. kTetgen + n is what TetGen itself threw.
enum WorkerExit {
  kWorkerDone = 0,
  kWorkerOutOfMemory = 11,
  kWorkerBadJob = 12,
  kWorkerTetgen = 20
};

void WriteTetgenJob(const std::filesystem::path& folder, const TetgenJob& job);

// In the child: reads the job of a folder, fills it, leaves the mesh there. Returns a WorkerExit.
int RunTetgenWorker(const std::filesystem::path& folder) noexcept;

// Nodes and elements as the worker left them, in VTK's node order. Throws Error(kFile).
TetMesh ReadTetgenMesh(const std::filesystem::path& folder);

}  // namespace arthro::authoring

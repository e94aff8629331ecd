// TetGen in a process of its own, because it may crash, abort, loop or exhaust memory on some
// inputs. The parent writes a job into a folder, runs `PROGRAM tetgen-worker FOLDER`, and reads the
// mesh that the worker left there.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "simulation/scene/mesh/tet_mesh.h"

namespace arthro::authoring {

// Ball in which no tetrahedron has an edge longer than max_edge.
struct FinePlace {
  glm::dvec3 centre{0.0};
  double radius = 0, max_edge = 0;
};

struct TetgenJob {
  std::string switches;       // TetGen's own switches
  double flat_angle = 180;    // deg; facets that meet at more than this count as one plane
  double max_dihedral = 165;  // deg; flatter elements are smoothed at the end
  double max_edge = 0;        // tetrahedra with a longer edge are split; 0: none
  double memory_limit = 0;    // bytes in addition to the program itself
  double time_limit = 0;      // s of processor time: the worker's own stop if its parent dies
  std::vector<FinePlace> fine;
  std::vector<glm::dvec3> points;
  std::vector<std::array<int, 3>> triangles;
};

// Exit codes of the worker. kTetgen + n is an error n that TetGen threw.
enum WorkerExit {
  kWorkerDone = 0,
  kWorkerOutOfMemory = 11,
  kWorkerBadJob = 12,
  kWorkerTetgen = 20
};

void WriteTetgenJob(const std::filesystem::path& folder, const TetgenJob& job);

// Runs in the child: reads the job of a folder, fills it, writes the mesh there. Returns a
// WorkerExit.
int RunTetgenWorker(const std::filesystem::path& folder) noexcept;

// Reads the worker's nodes and elements, in VTK's node order. Throws Error(kFile).
TetMesh ReadTetgenMesh(const std::filesystem::path& folder);

}  // namespace arthro::authoring

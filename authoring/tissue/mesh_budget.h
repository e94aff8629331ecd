// How fine a tissue's mesh may be: sizes with the error that they leave and the time that a step
// takes, so that an author chooses by what it costs. Measured on the digital knee's meniscus.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "authoring/tissue/pull_middles.h"
#include "authoring/tissue/tetrahedralize.h"
#include "simulation/scene/scene.h"

namespace arthro::authoring {

enum class MeshSize { kCoarse, kDefault, kFine };

struct MeshBudget {
  MeshSize size;
  const char* name;     // "coarse"
  int elements;         // quadratic; about so many are made
  double error;         // share by which it gives way too little under a probe, at worst
  double probed_error;  // the same, told of the places
  double step_ms;       // an implicit step at 60 Hz, one thread, without contact
};

std::span<const MeshBudget> MeshBudgets();
const MeshBudget& BudgetOf(MeshSize size);
// "About 300 elements: …"
std::string BudgetWords(const MeshBudget& budget);

struct MeshWish {
  int elements = 300;                                          // quadratic; about so many are made
  std::vector<Ball> fixed;                                     // where the tissue is held (scene.h)
  std::vector<Ball> probed;                                    // where it is probed
  double time_limit = 120.0;                                   // s, of the whole job
  double memory_limit = 2048.0;                                // MB, of the mesher
  std::optional<std::chrono::steady_clock::time_point> begun;  // not given: at the call
};
inline constexpr int kFewestElements = 20, kMostBudgetElements = 20000;

// Quadratic elements, about as many as wished: the surface is made coarse first, finest in the
// probed places and finer the further from where the tissue is held, since what is free is what is
// touched; then the middles of edges go onto the fine surface. Throws as Tetrahedralize does, and
// Error(kBadArgument) for a probed place that touches nothing.
TetMesh TetrahedralizeToBudget(const SurfaceMesh& surface, const SurfaceSource& source,
                               const MeshWish& wish, TetrahedralizeReport* report,
                               const Progress& progress = {},
                               const std::filesystem::path& program = kThisProgram);

}  // namespace arthro::authoring

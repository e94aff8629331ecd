// Mesh sizes with their error and the time of a step, so that an author can choose by cost.
// Measured on the digital knee's meniscus.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "authoring/tissue/tetrahedra/pull_middles.h"
#include "authoring/tissue/tetrahedra/tetrahedralize.h"
#include "simulation/scene/scene.h"

namespace arthro::authoring {

enum class MeshSize { kCoarse, kDefault, kFine };

struct MeshBudget {
  MeshSize size;
  const char* name;     // "coarse"
  int elements;         // quadratic elements, approximately
  double error;         // share by which a probe's indentation is too small, at worst
  double probed_error;  // the same with the probed places given
  double step_ms;       // an implicit step at 60 Hz, one thread, without contact
};

std::span<const MeshBudget> MeshBudgets();
const MeshBudget& BudgetOf(MeshSize size);
// ms of a step of a mesh of so many elements: between the measured budgets, and beyond them in
// proportion. Its ratios carry over to another machine, its values do not.
double StepTimeOf(int elements);
// Returns a sentence such as "About 300 elements: …".
std::string BudgetWords(const MeshBudget& budget);

struct MeshWish {
  int elements = 300;            // quadratic elements, approximately
  std::vector<Ball> fixed;       // places where the tissue is held (scene.h)
  std::vector<Ball> probed;      // places where it is probed
  double time_limit = 120.0;     // s, whole job
  double memory_limit = 2048.0;  // MB, mesher
  std::optional<std::chrono::steady_clock::time_point> begun;  // not given: at the call
};
inline constexpr int kFewestElements = 20, kMostBudgetElements = 20000;

// Makes about as many quadratic elements as wished. Simplifies the surface first: finest in the
// probed places, and finer with the distance from where the tissue is held, because free parts are
// the ones that are touched. Then moves the middles of edges onto the fine surface. Throws as
// Tetrahedralize does, and Error(kBadArgument) for a probed place that touches nothing.
TetMesh TetrahedralizeToBudget(const SurfaceMesh& surface, const SurfaceSource& source,
                               const MeshWish& wish, TetrahedralizeReport* report,
                               const Progress& progress = {},
                               const std::filesystem::path& program = kThisProgram);

}  // namespace arthro::authoring

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
  const char* name;  // "coarse"
  int elements;      // quadratic; about so many are made
  double error;      // share by which it gives way too little under a probe
  double step_ms;    // an implicit step at 60 Hz, one thread, without contact
};

std::span<const MeshBudget> MeshBudgets();
const MeshBudget& BudgetOf(MeshSize size);
// "About 300 elements: …"
std::string BudgetWords(const MeshBudget& budget);

// Quadratic elements, about as many as the size says: the surface is made coarse first, finer the
// further from where the tissue is held, since what is free is what is touched; then the middles of
// edges go onto the fine surface. Throws as Tetrahedralize does.
TetMesh TetrahedralizeToBudget(const SurfaceMesh& surface, const SurfaceSource& source,
                               MeshSize size, const std::vector<Ball>& fixed,
                               TetrahedralizeReport* report, const Progress& progress = {},
                               const std::filesystem::path& program = kThisProgram);

}  // namespace arthro::authoring

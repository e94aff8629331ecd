// Speed against error of deformable tissue, by element, mesh, tolerance and law, on cases with
// known continuum answers. Two errors are separate: the mesh's error when it is solved exactly (to
// 1e-10), and the solver's error on that mesh. Times are processor times of one thread. Statics:
// one whole solve, to 1e-8. Frames: a step load that holds, then oscillates like a hand; time per
// frame with the factor of the rest state throughout, and the largest difference from the same
// frames solved to 1e-10.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "simulation/core/options.h"
#include "simulation/core/progress.h"
#include "tests/support/tissue/tissue_cases.h"

namespace arthro::app {

struct TissueBenchOptions {
  std::string only;
  int frames = 48;
  double frame_rate = 60;
  int max_elements = 10000;
  template <class V>
  void Visit(V&& v) {
    v("only", only, Any{}, "", "Cases whose names begin so; empty for all of them.");
    v("frames", frames, Range{4, 100000}, "",
      "Frames of a load course; the load is constant for a third of them.");
    v("frame_rate", frame_rate, Range{1, 10000}, "Hz", "Frames per second.");
    v("max_elements", max_elements, Range{1, 1000000}, "",
      "Largest mesh that is measured; the largest of all has 20736.");
  }
};

struct TissueBenchRow {
  std::string course;  // "static" or "frames"
  std::string name;    // case
  std::string mesh;    // "T10 24x4x2"
  int order = 1;
  simulation::Law law = simulation::Law::kStableNeoHookean;
  double tolerance = 0;
  int elements = 0, nodes = 0;
  double factor_ms = 0;
  double step_ms = 0, step_p99_ms = 0;  // per frame; static: whole solve
  double newton = 0, iterations = 0;    // mean per step; static: sum
  int most_iterations = 0;              // per step
  double model_error = 0;               // relative to the continuum, signed
  double solver_error = 0;              // relative to this mesh's exact value
  int frames_to_5 = -1,
      frames_to_1 = -1;  // until the answer to the step load stays within 5 %, 1 %
  bool converged = true;
};

struct TissueBench {
  TissueBenchOptions options;
  std::vector<TissueBenchRow> rows;
};

struct TissueBenchMesh {
  std::string words;
  TetMesh mesh;
};
// Meshes of T4, then T10, from coarse to fine, up to `max_elements`.
std::vector<TissueBenchMesh> TissueBenchMeshes(test::TissueBody body, int max_elements);

// A case solved exactly on a mesh: the watched value, and its error against the continuum.
struct ExactAnswer {
  double value = 0, model_error = 0;
  simulation::StepReport report;
};
ExactAnswer SolveExactly(const test::TissueCase& c, simulation::Law law,
                         const test::TissueProblem& problem);

// Throws Error(kBadArgument) when no case is named so.
TissueBench RunTissueBench(const TissueBenchOptions& options, const Progress& progress);

std::string TableOf(const TissueBench& bench);
nlohmann::json JsonOf(const TissueBench& bench);
std::string PlotOf(const TissueBench& bench);  // SVG, error of frames over time

}  // namespace arthro::app

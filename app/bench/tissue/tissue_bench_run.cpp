#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "app/bench/quantile.h"
#include "app/bench/tissue/tissue_bench.h"
#include "simulation/core/error.h"
#include "simulation/core/process_cost.h"

namespace arthro::app {
namespace {

using namespace test;

using simulation::BodyState;
using simulation::ImplicitSolver;
using simulation::Law;
using simulation::SolverOptions;
using simulation::StepReport;

constexpr double kExactTolerance = 1e-10, kStaticTolerance = 1e-8;
constexpr double kFrameTolerances[] = {1e-1, 1e-2, 1e-3};

SolverOptions Exact() {
  SolverOptions options;
  options.tolerance = kExactTolerance;
  options.max_newton = 100;
  options.max_iterations = 5000;
  return options;
}

BodyState AtRest(const TissueProblem& problem) {
  const auto& rest = problem.model->mesh().rest_positions;
  return {rest, std::vector<glm::dvec3>(rest.size(), glm::dvec3(0.0))};
}

// Share of the load: full for a third of the course, then between full and half at 1.5 Hz.
double ShareAt(int frame, const TissueBenchOptions& options) {
  const int hold = options.frames / 3;
  if (frame < hold) return 1;
  const double turn = 2 * std::numbers::pi * 1.5 * (frame - hold + 1) / options.frame_rate;
  return 0.75 + 0.25 * std::cos(turn);
}

struct Course {
  std::vector<double> watch, ms;  // per frame
  double newton = 0, iterations = 0;
  int most_iterations = 0;
  bool converged = true;
};

Course RunCourse(const TissueProblem& problem, const SolverOptions& solver_options,
                 const TissueBenchOptions& options) {
  ImplicitSolver solver(problem.model, problem.fixed, solver_options);
  BodyState state = AtRest(problem);
  Course course;
  std::vector<glm::dvec3> load(problem.load.size());
  for (int frame = 0; frame < options.frames; ++frame) {
    const double share = ShareAt(frame, options);
    for (std::size_t i = 0; i < load.size(); ++i) load[i] = share * problem.load[i];
    const std::vector<glm::dvec3> target = TargetAt(problem, share);
    const double start = ThreadCpuMs();
    const StepReport report = solver.Step(state, load, {}, target, 1 / options.frame_rate, {});
    course.ms.push_back(ThreadCpuMs() - start);
    course.watch.push_back(Watch(problem, state.x, solver.reactions()));
    course.newton += report.newton;
    course.iterations += report.iterations;
    course.most_iterations = std::max(course.most_iterations, report.iterations);
    course.converged = course.converged && report.converged;
  }
  course.newton /= options.frames;
  course.iterations /= options.frames;
  return course;
}

// Time of ordering and factoring the rest state, as for a new body or a new cut.
double FactorMs(const TissueProblem& problem) {
  const double start = ThreadCpuMs();
  const ImplicitSolver solver(problem.model, problem.fixed);
  return ThreadCpuMs() - start;
}

// First frame, from 1, from which the watched value stays within `share` of `value` while the load
// does; −1: never.
int FramesTo(const Course& course, int hold, double value, double share) {
  int frames = -1;
  for (int i = hold; i-- > 0;) {
    if (std::abs(course.watch[static_cast<std::size_t>(i)] / value - 1) > share) break;
    frames = i + 1;
  }
  return frames;
}

}  // namespace

std::vector<TissueBenchMesh> TissueBenchMeshes(TissueBody body, int max_elements) {
  std::vector<TissueBenchMesh> meshes;
  const auto add = [&](int order, const Cells& cells) {
    const std::string words =
        fmt::format("T{} {}x{}x{}", order == 2 ? 10 : 4, cells[0], cells[1], cells[2]);
    switch (body) {
      case TissueBody::kBeam:
        meshes.push_back({words, BeamMesh(order, cells)});
        break;
      case TissueBody::kCook:
        meshes.push_back({words, CookMesh(order, cells)});
        break;
      case TissueBody::kBlock:
        meshes.push_back({words, BlockMesh(order, cells)});
        break;
      case TissueBody::kMeniscus:
        meshes.push_back({words, MeniscusMesh(order, MeniscusTicks(cells))});
        break;
    }
  };
  switch (body) {
    case TissueBody::kBeam:
      for (const Cells& cells : {Cells{20, 2, 2}, Cells{40, 4, 4}}) add(1, cells);
      add(1, {70, 7, 7});
      for (const Cells& cells : {Cells{10, 1, 1}, Cells{20, 2, 2}}) add(2, cells);
      break;
    case TissueBody::kCook:
      for (const Cells& cells : {Cells{8, 8, 2}, Cells{16, 16, 4}}) add(1, cells);
      add(1, {28, 28, 4});
      for (const Cells& cells : {Cells{4, 4, 1}, Cells{8, 8, 2}, Cells{12, 12, 2}}) add(2, cells);
      break;
    case TissueBody::kBlock:
      for (const Cells& cells : {Cells{4, 4, 4}, Cells{8, 8, 8}}) add(1, cells);
      add(1, {14, 14, 14});
      for (const Cells& cells : {Cells{2, 2, 2}, Cells{4, 4, 4}}) add(2, cells);
      break;
    case TissueBody::kMeniscus:
      for (const Cells& cells : {Cells{24, 4, 2}, Cells{48, 8, 4}}) add(1, cells);
      add(1, {72, 12, 4});
      for (const auto& [beyond, across] : {std::pair{3, 3}, {5, 3}, {8, 3}, {8, 4}, {10, 4}})
        meshes.push_back({fmt::format("T10 bent {}x{}x1", 2 * beyond + 1, across),
                          MeniscusMesh(2, BentMeniscusTicks(beyond, across))});
      add(2, {24, 4, 1});
      meshes.push_back({"T10 pressed 9x9x2", MeniscusMesh(2, PressedMeniscusTicks())});
      add(2, {24, 4, 2});
      break;
  }
  std::erase_if(meshes,
                [&](const TissueBenchMesh& m) { return m.mesh.ElementCount() > max_elements; });
  return meshes;
}

ExactAnswer SolveExactly(const TissueCase& c, Law law, const TissueProblem& problem) {
  ImplicitSolver solver(problem.model, problem.fixed, Exact());
  BodyState state = AtRest(problem);
  ExactAnswer answer;
  answer.report = solver.SolveStatic(state, problem.load, {}, problem.target, kExactTolerance, {});
  answer.value = Watch(problem, state.x, solver.reactions());
  answer.model_error = answer.value / ContinuumOf(c, law).value - 1;
  return answer;
}

TissueBench RunTissueBench(const TissueBenchOptions& options, const Progress& progress) {
  TissueBench bench{options, {}};
  std::vector<const TissueCase*> cases;
  for (const TissueCase& c : TissueCases())
    if (std::string(c.name).starts_with(options.only)) cases.push_back(&c);
  if (cases.empty()) TissueCaseOf(options.only);  // throws and lists the cases

  for (std::size_t k = 0; k < cases.size(); ++k) {
    const TissueCase& c = *cases[k];
    const auto meshes = TissueBenchMeshes(c.body, options.max_elements);
    for (std::size_t m = 0; m < meshes.size(); ++m)
      for (const Law law : {Law::kStableNeoHookean, Law::kCorotated}) {
        progress.Step(c.name, (static_cast<double>(k) +
                               static_cast<double>(m) / static_cast<double>(meshes.size())) /
                                  static_cast<double>(cases.size()));
        const TissueProblem problem = ProblemOf(c, law, meshes[m].mesh);
        const ExactAnswer exact = SolveExactly(c, law, problem);
        TissueBenchRow row;
        row.name = c.name;
        row.mesh = meshes[m].words;
        row.order = meshes[m].mesh.order;
        row.law = law;
        row.elements = meshes[m].mesh.ElementCount();
        row.nodes = problem.model->node_count();
        row.factor_ms = FactorMs(problem);
        row.model_error = exact.model_error;
        {
          row.course = "static";
          row.tolerance = kStaticTolerance;
          ImplicitSolver solver(problem.model, problem.fixed, Exact());
          BodyState state = AtRest(problem);
          const double start = ThreadCpuMs();
          const StepReport report =
              solver.SolveStatic(state, problem.load, {}, problem.target, kStaticTolerance, {});
          row.step_ms = row.step_p99_ms = ThreadCpuMs() - start;
          row.newton = report.newton;
          row.iterations = row.most_iterations = report.iterations;
          row.converged = report.converged && exact.report.converged;
          row.solver_error =
              std::abs(Watch(problem, state.x, solver.reactions()) / exact.value - 1);
          bench.rows.push_back(row);
        }
        // Frames are measured for the meniscus, under its own law.
        if (c.body != TissueBody::kMeniscus || law != Law::kStableNeoHookean) continue;
        const Course truth = RunCourse(problem, Exact(), options);
        for (const double tolerance : kFrameTolerances) {
          SolverOptions solver_options;
          solver_options.tolerance = tolerance;
          const Course course = RunCourse(problem, solver_options, options);
          row.course = "frames";
          row.tolerance = tolerance;
          row.step_ms = Quantile(course.ms, 0.5);
          row.step_p99_ms = Quantile(course.ms, 0.99);
          row.newton = course.newton;
          row.iterations = course.iterations;
          row.most_iterations = course.most_iterations;
          row.converged = truth.converged;
          row.solver_error = 0;
          for (std::size_t i = 0; i < course.watch.size(); ++i)
            row.solver_error = std::max(row.solver_error,
                                        std::abs((course.watch[i] - truth.watch[i]) / exact.value));
          row.frames_to_5 = FramesTo(course, options.frames / 3, exact.value, 0.05);
          row.frames_to_1 = FramesTo(course, options.frames / 3, exact.value, 0.01);
          bench.rows.push_back(row);
        }
        row.frames_to_5 = row.frames_to_1 = -1;
      }
  }
  return bench;
}

}  // namespace arthro::app

#include "simulation/tissue/cases/case_run.h"

#include <algorithm>
#include <chrono>
#include <memory>

#include <fmt/format.h>

#include "simulation/core/error.h"
#include "simulation/tissue/solver/implicit_solver.h"

namespace arthro::simulation {
namespace {

double MsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
      .count();
}

// Limits chosen for accuracy rather than time.
constexpr int kMostNewton = 50, kMostIterations = 2000;

SetResults EvaluateSets(const TetMesh& mesh, std::span<const glm::dvec3> x,
                        std::span<const glm::dvec3> reactions) {
  SetResults results;
  for (const auto& [name, member] : mesh.sets) {
    SetResult& result = results[name];
    int count = 0;
    for (std::size_t i = 0; i < member.size(); ++i) {
      if (!member[i]) continue;
      ++count;
      result.mean_displacement += x[i] - mesh.rest_positions[i];
      result.reaction += reactions[i];
    }
    result.mean_displacement /= std::max(count, 1);
  }
  return results;
}

}  // namespace

CaseResult RunCase(const TissueCase& c, const Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  const TetMesh& mesh = c.mesh;
  const std::size_t nodes = mesh.rest_positions.size();
  progress.Step("factoring", 0.0);

  // Collects fixed, displaced and loaded nodes.
  FixedAxes fixed(nodes, 0);
  std::vector<glm::dvec3> target = mesh.rest_positions, load(nodes, glm::dvec3(0.0));
  for (const CaseFixed& one : c.fixed)
    for (std::size_t i = 0; i < nodes; ++i)
      if (mesh.sets.at(one.set)[i]) fixed[i] |= one.axes;
  for (const CaseDisplaced& one : c.displaced)
    for (std::size_t i = 0; i < nodes; ++i)
      if (mesh.sets.at(one.set)[i]) {
        fixed[i] = 7;
        target[i] = mesh.rest_positions[i] + one.displacement;
      }
  const auto model = std::make_shared<const FemModel>(mesh, c.material);
  for (const CaseLoad& one : c.loads)
    if (AddSurfaceLoad(mesh, mesh.sets.at(one.set), one.total_force, load) == 0)
      throw Error(Code::kBadData,
                  fmt::format("the set \"{}\" has no triangle of the surface, so that a load on it "
                              "has no place; mark all corners of the loaded faces",
                              one.set));
  model->AddBodyForce(c.body_force, load);

  SolverOptions options;
  options.tolerance = c.tolerance;
  options.max_newton = kMostNewton;
  options.max_iterations = kMostIterations;
  options.max_speed = 1e4;
  ImplicitSolver solver(model, fixed, options);
  BodyState state{mesh.rest_positions, std::vector<glm::dvec3>(nodes, glm::dvec3(0.0))};

  CaseResult result;
  const auto take = [&](const StepReport& report) {
    result.residual = std::max(result.residual, report.residual);
    result.iterations += report.newton;
    result.linear_iterations += report.iterations;
    result.energy = report.energy;
    result.inverted_elements = std::max(result.inverted_elements, report.inverted);
    result.used_fallback = result.used_fallback || report.used_fallback;
    return report.converged && report.is_finite && report.inverted == 0;
  };
  if (!c.is_dynamic) {
    progress.Step("solving", 0.1);
    result.converged = take(solver.SolveStatic(state, load, {}, target, c.tolerance, {}));
  } else {
    result.converged = true;
    for (int step = 0; step < c.steps; ++step) {
      progress.Step("stepping", static_cast<double>(step) / c.steps);
      const auto begin = std::chrono::steady_clock::now();
      const StepReport report = solver.Step(state, load, {}, target, c.dt, {});
      result.converged = take(report) && result.converged;
      result.history.push_back(
          {(step + 1) * c.dt, MsSince(begin), EvaluateSets(mesh, state.x, solver.reactions())});
      if (!report.is_finite) break;
    }
  }
  progress.Step("done", 1.0);
  result.sets = EvaluateSets(mesh, state.x, solver.reactions());
  result.x = state.x;
  result.wall_ms = MsSince(start);
  return result;
}

}  // namespace arthro::simulation

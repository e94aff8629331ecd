// Our implicit solver beside Bullet's implicit deformables on the same linear tetrahedra, masses,
// held nodes, law (corotated) and load: a meniscus at rest on whose patch 0.05 N come at once, at
// 60 steps per second. How many steps, and how much processor time of one thread, until the inner
// edge stays within 5 % and 1 % of where this mesh's exact static answer has it. Bullet as it
// comes, and with as many iterations of its solver as its answer needs, which is faster for it on
// large meshes.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "simulation/core/process_cost.h"
#include "tests/benchmark/bench_report.h"
#include "tests/benchmark/bullet_body.h"
#include "tests/support/tissue/tissue_cases.h"

namespace arthro {
namespace {

using simulation::Law;
using test::TissueProblem;

constexpr double kDt = 1.0 / 60;

// One body in one solver, as time and watched value a step.
struct Run {
  std::vector<double> ms, value;  // m
};

// First step, from 1, from which the value stays within `share` of `exact`, and the time until it.
struct Arrival {
  int steps = -1;
  double ms = 0;
};
Arrival ArrivalOf(const Run& run, double exact, double share) {
  Arrival arrival;
  std::size_t from = run.value.size();
  while (from > 0 && std::abs(run.value[from - 1] / exact - 1) <= share) --from;
  if (from == run.value.size()) return arrival;
  arrival.steps = static_cast<int>(from) + 1;
  for (std::size_t i = 0; i <= from; ++i) arrival.ms += run.ms[i];
  return arrival;
}

template <class Step, class Value>
Run Course(int steps, Step step, Value value) {
  Run run;
  for (int i = 0; i < steps; ++i) {
    const double start = ThreadCpuMs();
    step();
    run.ms.push_back(ThreadCpuMs() - start);
    run.value.push_back(value());
  }
  return run;
}

Run RunOurs(const TissueProblem& problem, double tolerance, int steps) {
  simulation::SolverOptions options;
  options.tolerance = tolerance;
  simulation::ImplicitSolver solver(problem.model, problem.fixed, options);
  simulation::BodyState state{problem.model->mesh().rest_positions, {}};
  state.v.assign(state.x.size(), glm::dvec3(0.0));
  return Course(
      steps, [&] { solver.Step(state, problem.load, {}, {}, kDt, {}); },
      [&] { return Watch(problem, state.x, solver.reactions()); });
}

Run RunBullet(const TissueProblem& problem, const test::BulletOptions& options, int steps) {
  const auto& mesh = problem.model->mesh();
  test::BulletBody body(mesh, problem.model->material(), problem.model->mass(),
                        mesh.sets.at("horns"), problem.load, options);
  const auto node = static_cast<std::size_t>(problem.watched.front());
  return Course(
      steps, [&] { body.Step(kDt); },
      [&] { return body.Position(problem.watched.front()).z - mesh.rest_positions[node].z; });
}

std::string Words(const Arrival& arrival) {
  return arrival.steps < 0 ? "never" : fmt::format("{:>2} {:>8.1f}", arrival.steps, arrival.ms);
}

void Print(const char* size, const std::string& what, const Run& run, double exact) {
  std::vector<double> sorted = run.ms;
  std::sort(sorted.begin(), sorted.end());
  fmt::print("{:<3}{:<30}{:>9.2f}{:>9.2f}{:>14}{:>14}{:>10.3f}\n", size, what,
             sorted[sorted.size() / 2], sorted.back(), Words(ArrivalOf(run, exact, 0.05)),
             Words(ArrivalOf(run, exact, 0.01)), 100 * (run.value.back() / exact - 1));
}

struct Size {
  const char* words;
  test::Cells cells;
  int enough_iterations;  // with which Bullet's first step is within 5 %
  double goal;            // ratio of times to 5 %
};
constexpr Size kSizes[] = {
    {"S", {24, 4, 2}, 300, 10}, {"M", {48, 8, 4}, 600, 20}, {"L", {72, 12, 4}, 1000, 15}};

void Compare(const Size& size, bool quick) {
  const TissueProblem problem = ProblemOf(test::TissueCaseOf("meniscus_load"), Law::kCorotated,
                                          test::MeniscusMesh(1, test::MeniscusTicks(size.cells)));
  simulation::ImplicitSolver solver(problem.model, problem.fixed);
  simulation::BodyState state{problem.model->mesh().rest_positions, {}};
  state.v.assign(state.x.size(), glm::dvec3(0.0));
  solver.SolveStatic(state, problem.load, {}, {}, 1e-10, {});
  const double exact = Watch(problem, state.x, solver.reactions());
  const double start = ThreadCpuMs();
  { const simulation::ImplicitSolver fresh(problem.model, problem.fixed); }
  fmt::print(
      "{:<3}{} elements, {} nodes, exact static answer {:.5e} m; our factor of the rest "
      "state, once: {:.1f} ms\n",
      size.words, problem.model->mesh().ElementCount(), problem.model->node_count(), exact,
      ThreadCpuMs() - start);

  const int steps = quick ? 4 : 24;
  test::BulletOptions plain, enough;
  enough.max_cg_iterations = size.enough_iterations;
  enough.cg_tolerance = 1e-4;
  std::vector<Run> bullets{RunBullet(problem, plain, steps)};
  Print(size.words, "Bullet, as it comes", bullets[0], exact);
  if (size.enough_iterations != plain.max_cg_iterations) {
    bullets.push_back(RunBullet(problem, enough, steps));
    Print(size.words, fmt::format("Bullet, {} iterations, 1e-4", size.enough_iterations),
          bullets[1], exact);
  }
  for (const double tolerance : {1e-1, 1e-2, 1e-4}) {
    const Run ours = RunOurs(problem, tolerance, steps);
    Print(size.words, fmt::format("ours, tolerance {:.0e}", tolerance), ours, exact);
    for (std::size_t b = 0; b < bullets.size(); ++b)
      for (const double share : {0.05, 0.01}) {
        const Arrival mine = ArrivalOf(ours, exact, share);
        const Arrival its = ArrivalOf(bullets[b], exact, share);
        if (mine.steps < 0) continue;
        double whole = 0;  // time of a peer that never arrives
        for (const double ms : bullets[b].ms) whole += ms;
        fmt::print("{:<3}  to {:g} %: {}{:.1f} times as fast as Bullet {}{}\n", size.words,
                   100 * share, its.steps > 0 ? "" : "more than ",
                   (its.steps > 0 ? its.ms : whole) / mine.ms,
                   b == 0 ? "as it comes" : "at its best",
                   b == 0 && share == 0.05 ? fmt::format(", goal {:g}", size.goal) : "");
      }
  }
}

}  // namespace
}  // namespace arthro

int main(int argc, char** argv) {
  const arthro::test::BenchReport report("tissue beside Bullet, processor time of one thread", argc,
                                         argv);
  fmt::print("{:<3}{:<30}{:>9}{:>9}{:>14}{:>14}{:>10}\n", "", "solver", "ms/step", "worst",
             "5 %: step ms", "1 %: step ms", "end %");
  for (const auto& size : arthro::kSizes) {
    if (report.quick() && size.words != arthro::kSizes[0].words) break;
    arthro::Compare(size, report.quick());
  }
  return 0;
}

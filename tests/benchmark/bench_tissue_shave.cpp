// A meniscus of 504 T10 on its plateau under a running shaver that goes to and fro along the thin
// edge and down through it: what a step takes that solves, that cuts (ten times a second) and that
// makes the shape of a cut, in processor time of one thread, with what is left of the residual.
#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "simulation/core/free_memory.h"
#include "simulation/core/process_cost.h"
#include "tests/benchmark/bench_report.h"
#include "tests/simulation/tissue/body/meniscus_body.h"
#include "tests/simulation/tissue/body/plateau.h"
#include "tests/support/ticks.h"

namespace arthro::simulation {
namespace {

using test::kFrame;

struct Kind {
  std::vector<double> seconds, residual;
  int most_iterations = 0;  // per linear system, mean over its step
};

double At(std::vector<double> values, double share) {
  std::ranges::sort(values);
  return values.empty() ? 0 : values[static_cast<std::size_t>(share * (values.size() - 1))];
}

void Run(const test::BenchReport& report) {
  const BodySpec spec = test::MeniscusBody();
  DeformableBody body(spec, {});
  TakeMemoryAhead(kMostMemoryAhead);  // done by the thread of a practice too
  const test::Plateau plateau(spec.portal_from_body);
  WorldTool shaver;
  shaver.shape = ShapeOf(ToolKind::kShaver);
  shaver.now.is_present = shaver.now.is_running = true;
  Kind solved, cut, shaped;
  const int steps = report.quick() ? 20 : 600;
  for (int i = 0; i < steps; ++i) {
    const double angle = 0.5 * std::sin(0.04 * i), height = 1.5e-3 - std::min(i * 1e-5, 1.5e-3);
    shaver.now.portal_from_tool =
        spec.portal_from_body *
        Rigid3{glm::angleAxis(std::numbers::pi, glm::dvec3(1, 0, 0)),
               {0.0115 * std::cos(angle), 0.0115 * std::sin(angle), height}};
    ToolCoupling coupling;
    const double begin = ThreadCpuMs();
    const BodyReport step = body.Step({&shaver, 1}, &plateau, kFrame, {&coupling, 1});
    const double end = ThreadCpuMs();
    Kind& kind = step.was_cut ? cut : step.took_shape ? shaped : solved;
    kind.seconds.push_back(1e-3 * (end - begin));
    kind.residual.push_back(step.step.residual);
    kind.most_iterations =
        std::max(kind.most_iterations, step.step.iterations / std::max(1, step.step.newton));
    if (body.WantsSideWork()) {  // on another thread in practice
      body.BeginSideWork();
      body.RunSideWork();
      body.TakeSideWork();
    }
  }
  const auto row = [&](const char* name, const Kind& kind) {
    report.Row(fmt::format("{}, {} steps", name, kind.seconds.size()),
               {At(kind.seconds, 0.5), At(kind.seconds, 0.99)},
               fmt::format("residual {:.1e}, p99 {:.1e}; {} iterations a system at most",
                           At(kind.residual, 0.5), At(kind.residual, 0.99), kind.most_iterations));
  };
  row("shaver on, solved", solved);
  row("shaver on, cut", cut);
  row("shaver on, shape made", shaped);
  fmt::print("{:.1f} mm3 taken in {} cuts\n", 1e9 * body.cut_report().removed,
             body.cut_report().cuts);
}

}  // namespace
}  // namespace arthro::simulation

int main(int argc, char** argv) {
  const arthro::test::BenchReport report("tissue under the shaver", argc, argv);
  arthro::simulation::Run(report);
}

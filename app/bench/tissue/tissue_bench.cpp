#include "app/bench/tissue/tissue_bench.h"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/bench/machine_words.h"
#include "app/bench/speed_error_plot.h"
#include "simulation/core/options_json.h"

namespace arthro::app {
namespace {

using namespace test;

constexpr double kBudgetTolerance = 1e-2;  // default tolerance of a frame

const char* LawWords(simulation::Law law) {
  return law == simulation::Law::kCorotated ? "cor" : "snh";
}

std::string Frames(int frames) { return frames < 0 ? "-" : std::to_string(frames); }

bool IsBudgetRow(const TissueBenchRow& row) {
  return row.course == "frames" && row.order == 2 && row.tolerance == kBudgetTolerance;
}

}  // namespace

std::string TableOf(const TissueBench& bench) {
  std::string table = fmt::format(
      "# tissue: speed against error | {} | processor time of one thread, {:g} frames per second\n"
      "{:<7} {:<15} {:<18} {:<4}{:>7} {:>6}{:>7}{:>10}{:>9}{:>9}{:>8}{:>7}{:>6}{:>10}{:>11}{:>5}"
      "{:>5}\n",
      MachineWords(), bench.options.frame_rate, "course", "case", "mesh", "law", "toler.", "elem.",
      "nodes", "factor ms", "step ms", "p99 ms", "newton", "pcg", "most", "model %", "solver %",
      "5 %", "1 %");
  for (const auto& row : bench.rows)
    table += fmt::format(
        "{:<7} {:<15} {:<18} {:<4}{:>7.0e} {:>6}{:>7}{:>10.2f}{:>9.2f}{:>9.2f}{:>8.2f}{:>7.1f}"
        "{:>6}{:>+10.2f}{:>11.2g}{:>5}{:>5}{}\n",
        row.course, row.name, row.mesh, LawWords(row.law), row.tolerance, row.elements, row.nodes,
        row.factor_ms, row.step_ms, row.step_p99_ms, row.newton, row.iterations,
        row.most_iterations, 100 * row.model_error, 100 * row.solver_error, Frames(row.frames_to_5),
        Frames(row.frames_to_1), row.converged ? "" : "  not converged");
  table +=
      "model: this mesh solved to 1e-10 against the continuum; solver: against this mesh solved to "
      "1e-10;\npcg, newton: a step, of a static solve the sum; 5 %, 1 %: frames until a step "
      "load's "
      "answer stays so near.\n";

  table += "\n# mesh budget: T10, stable neo-Hookean, frames to a tolerance of 1e-2\n";
  table += fmt::format("{:>6}  {:<18} {:<16}{:>9}{:>11}{:>9}{:>9}\n", "T10", "mesh", "case",
                       "error %", "factor ms", "step ms", "p99 ms");
  for (const auto& row : bench.rows)
    if (IsBudgetRow(row))
      table += fmt::format("{:>6}  {:<18} {:<16}{:>9.1f}{:>11.2f}{:>9.2f}{:>9.2f}\n", row.elements,
                           row.mesh, row.name, 100 * (std::abs(row.model_error) + row.solver_error),
                           row.factor_ms, row.step_ms, row.step_p99_ms);
  return table;
}

nlohmann::json JsonOf(const TissueBench& bench) {
  const auto frames = [](int count) {
    return count < 0 ? nlohmann::json(nullptr) : nlohmann::json(count);
  };
  nlohmann::json rows = nlohmann::json::array();
  for (const auto& row : bench.rows)
    rows.push_back({{"course", row.course},
                    {"case", row.name},
                    {"mesh", row.mesh},
                    {"order", row.order},
                    {"law", LawWords(row.law)},
                    {"tolerance", row.tolerance},
                    {"elements", row.elements},
                    {"nodes", row.nodes},
                    {"factor_ms", row.factor_ms},
                    {"step_ms_median", row.step_ms},
                    {"step_ms_p99", row.step_p99_ms},
                    {"newton", row.newton},
                    {"pcg_iterations", row.iterations},
                    {"pcg_iterations_most", row.most_iterations},
                    {"model_error", row.model_error},
                    {"solver_error", row.solver_error},
                    {"frames_to_5_percent", frames(row.frames_to_5)},
                    {"frames_to_1_percent", frames(row.frames_to_1)},
                    {"converged", row.converged}});
  nlohmann::json references = nlohmann::json::array();
  for (const TissueCase& c : TissueCases())
    references.push_back({{"case", c.name},
                          {"snh", {c.stable_neo_hookean.value, c.stable_neo_hookean.tolerance}},
                          {"cor", {c.corotated.value, c.corotated.tolerance}}});
  return {{"schema", "arthroscene.bench.tissue/1"},
          {"machine", MachineWords()},
          {"options", JsonFromOptions(bench.options)},
          {"continuum", references},
          {"rows", rows}};
}

std::string PlotOf(const TissueBench& bench) {
  std::vector<PlotMark> marks;
  for (const auto& row : bench.rows)
    if (row.course == "frames")
      marks.push_back({row.name, fmt::format("{} {:.0e}", row.mesh, row.tolerance), row.step_ms,
                       100 * (std::abs(row.model_error) + row.solver_error),
                       row.order == 2 ? 1.0 : 0.0});
  return SpeedErrorSvg(
      {"Deformable meniscus: speed against error", "processor time per frame, ms",
       "error of mesh and solver, %", "filled: quadratic elements; hollow: linear ones",
       "continuum values of finer and finer quadratic hexahedra"},
      marks);
}

}  // namespace arthro::app

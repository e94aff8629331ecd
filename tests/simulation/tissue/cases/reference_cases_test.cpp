// Every case of the reference set: compares the solver with the exact answer of the same mesh and
// law, and prints the mesh's error relative to the continuum.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "simulation/tissue/cases/case_run.h"
#include "tests/support/shared_data.h"

namespace arthro::simulation {
namespace {

double Measured(const CaseResult& result, const nlohmann::json& quantity) {
  if (quantity["what"] == "energy") return result.energy;
  const SetResult& set = result.sets.at(quantity["set"]);
  const int axis = quantity["axis"];
  return quantity["what"] == "reaction" ? set.reaction[axis] : set.mean_displacement[axis];
}

// Solves all cases and prints the relative model error of the first quantity, as a table would.
void SolveAll(const char* part) {
  ARTHRO_REQUIRE_SHARED(folder, "reference/tissue");
  const auto expected = nlohmann::json::parse(std::ifstream(folder / "expected.json"));
  int cases = 0;
  double worst = 0, ms = 0;
  for (const auto& [name, quantities] : expected.items()) {
    if (name.find(part) == std::string::npos) continue;
    SCOPED_TRACE(name);
    const CaseResult result = RunCase(ReadCase(folder / name));
    EXPECT_TRUE(result.converged);
    EXPECT_LE(result.residual, 1e-8);
    double solver_error = 0, model_error = 0;
    for (const auto& quantity : quantities) {
      const double got = Measured(result, quantity);
      const double continuum = quantity["continuum"];
      // Skips components that hardly move, because their relative model error is meaningless.
      if (quantity["what"] == "energy" || quantity == quantities.front())
        model_error = std::max(model_error, std::abs(got / continuum - 1));
      if (quantity.contains("discrete"))
        solver_error =
            std::max(solver_error, std::abs(got / quantity["discrete"].get<double>() - 1));
    }
    // Accuracy of the reference values: eight digits, six for the smallest.
    EXPECT_LE(solver_error, 1e-6);
    fmt::print(
        "{:32} newton {:3} cg {:4} residual {:.0e} solver error {:.0e} model error {:.1f} % {:.0f} "
        "ms\n",
        name, result.iterations, result.linear_iterations, result.residual, solver_error,
        100 * model_error, result.wall_ms);
    ++cases;
    worst = std::max(worst, solver_error);
    ms += result.wall_ms;
  }
  fmt::print("{} cases, largest solver error {:.1e}, {:.0f} ms\n", cases, worst, ms);
  EXPECT_GE(cases, 18);
}

TEST(ReferenceCases, LinearElementsS) { SolveAll("T4_S"); }
TEST(ReferenceCases, LinearElementsM) { SolveAll("T4_M"); }
TEST(ReferenceCases, QuadraticElementsS) { SolveAll("T10_S"); }

}  // namespace
}  // namespace arthro::simulation

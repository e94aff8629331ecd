#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "simulation/core/atomic_file.h"
#include "simulation/scene/mesh/mesh_io.h"
#include "tests/support/run_program.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"

namespace arthro::test {
namespace {

// A bar of 4×1×1 cubes of 10 mm, each of six tetrahedra around a diagonal; "left" and "right" are
// its ends.
TetMesh Bar() {
  constexpr int kLong = 4;
  constexpr double kEdge = 0.01;
  TetMesh mesh;
  const auto node = [](int i, int j, int k) { return (i * 2 + j) * 2 + k; };
  for (int i = 0; i <= kLong; ++i)
    for (int j = 0; j < 2; ++j)
      for (int k = 0; k < 2; ++k) {
        mesh.rest_positions.push_back(kEdge * glm::dvec3(i, j, k));
        mesh.sets["left"].push_back(i == 0);
        mesh.sets["right"].push_back(i == kLong);
        mesh.sets["nobody"].push_back(0);
      }
  constexpr int kPaths[6][2] = {{1, 3}, {3, 2}, {2, 6}, {6, 4}, {4, 5}, {5, 1}};
  for (int i = 0; i < kLong; ++i)
    for (const auto& [a, b] : kPaths) {
      const auto corner = [&](int c) { return node(i + (c >> 2), c >> 1 & 1, c & 1); };
      mesh.elements.insert(mesh.elements.end(), {corner(0), corner(b), corner(a), corner(7)});
    }
  return mesh;
}

nlohmann::json BarCase() {
  return nlohmann::json::parse(
      R"({"mesh": "bar.vtu", "order": 1, "mode": "static", "tolerance": 1e-8,
    "material": {"model": "stable_neo_hookean", "young_modulus": 1e6, "poisson_ratio": 0.3, "density": 1100},
    "fixed": [{"set": "left", "axes": "xyz"}], "loads": [{"set": "right", "total_force": [0.5, 0, 0]}]})");
}

struct SolveRun {
  ProgramResult program;
  nlohmann::json json;
  TempFolder folder;
};

void Solve(SolveRun& run, const nlohmann::json& tissue_case, const std::string& flags = "") {
  WriteTetMesh(run.folder / "bar.vtu", Bar());
  std::ofstream(run.folder / "case.json") << tissue_case.dump();
  const std::string output = (run.folder / "result.json").string();
  run.program =
      RunProgram("solve " + (run.folder / "case.json").string() + " -o " + output + " " + flags);
  if (std::ifstream stream(output); stream) run.json = nlohmann::json::parse(stream);
}

TEST(SolveJob, ABarPulledAtItsEndIsHeldByTheSameForce) {
  SolveRun run;
  Solve(run, BarCase(), "--vtu " + (run.folder / "out.vtu").string());
  ASSERT_EQ(run.program.exit_code, 0) << run.program.err;
  for (const char* key : {"schema", "converged", "residual", "iterations", "wall_ms", "sets",
                          "energy", "inverted_elements", "history"})
    EXPECT_TRUE(run.json.contains(key)) << key;
  EXPECT_TRUE(run.json["converged"]);
  EXPECT_LE(run.json["residual"].get<double>(), 1e-8);
  EXPECT_EQ(run.json["inverted_elements"], 0);
  // Equilibrium, to the residual asked for times the 0.5 N.
  EXPECT_NEAR(run.json["sets"]["left"]["reaction"][0].get<double>(), -0.5, 1e-8);
  const double pull = run.json["sets"]["right"]["mean_displacement"][0];
  // F L / (E A) = 0.2 mm for a slim bar; held ends and these few elements stiffen it, by under 15
  // %.
  EXPECT_NEAR(pull, 2e-4, 0.15 * 2e-4);
  const TetMesh deformed = ReadTetMesh(run.folder / "out.vtu");
  double mean = 0;
  for (int i = 16; i < 20; ++i) mean += (deformed.rest_positions[i].x - 0.04) / 4;
  EXPECT_NEAR(mean, pull, 1e-15);
}

TEST(SolveJob, WritesToStandardOutput) {
  TempFolder folder;
  WriteTetMesh(folder / "bar.vtu", Bar());
  std::ofstream(folder / "case.json") << BarCase().dump();
  const ProgramResult program = RunProgram("solve " + (folder / "case.json").string() + " -o -");
  ASSERT_EQ(program.exit_code, 0) << program.err;
  EXPECT_TRUE(nlohmann::json::parse(program.out)["converged"]);
}

TEST(SolveJob, ADynamicCaseComesToRestAtTheStaticAnswer) {
  SolveRun statics, dynamics;
  Solve(statics, BarCase());
  auto dynamic_case = BarCase();
  dynamic_case["mode"] = "dynamic";
  dynamic_case["dt"] = 0.02;
  dynamic_case["steps"] = 40;
  Solve(dynamics, dynamic_case);
  ASSERT_EQ(dynamics.program.exit_code, 0) << dynamics.program.err;
  ASSERT_EQ(dynamics.json["history"].size(), 40u);
  EXPECT_DOUBLE_EQ(dynamics.json["history"][39]["t"].get<double>(), 0.8);
  const double rest = statics.json["sets"]["right"]["mean_displacement"][0];
  const double end = dynamics.json["sets"]["right"]["mean_displacement"][0];
  EXPECT_NEAR(end, rest, 1e-6 * rest);
}

TEST(SolveJob, TheSameCaseGivesTheSameNumbers) {
  SolveRun one, two;
  Solve(one, BarCase());
  Solve(two, BarCase());
  for (const char* key : {"residual", "iterations", "sets", "energy"})
    EXPECT_EQ(one.json[key], two.json[key]) << key;
}

// Every fault has its own line in tests/simulation/tissue/solver/case_io_test.cpp.
TEST(SolveJob, RefusesABadCaseInOneSentenceAndWritesNothing) {
  SolveRun run;
  auto bad = BarCase();
  bad["fixed"][0]["set"] = "rihgt";
  Solve(run, bad);
  EXPECT_EQ(run.program.exit_code, 1);
  EXPECT_NE(run.program.err.find("it has left, nobody, right"), std::string::npos)
      << run.program.err;
  EXPECT_TRUE(run.json.is_null());
}

TEST(SolveJob, OverwritesNothingThatItReadsAndNoResultWithAnother) {
  TempFolder folder;
  WriteTetMesh(folder / "bar.vtu", Bar());
  std::ofstream(folder / "case.json") << BarCase().dump();
  const std::string mesh = ReadWholeFile(folder / "bar.vtu"),
                    tissue_case = ReadWholeFile(folder / "case.json");
  const auto in = [&](const char* name) { return (folder / name).string(); };
  for (const std::string& outputs :
       {in("bar.vtu"), in("./case.json"), in("r.json") + " --vtu " + in("./bar.vtu"),
        in("r.vtu") + " --vtu " + in("./r.vtu"), in("r.json") + " --vtu " + in("none/r.vtu")}) {
    const ProgramResult program = RunProgram("solve " + in("case.json") + " -o " + outputs);
    EXPECT_EQ(program.exit_code, 1) << outputs;
    EXPECT_EQ(std::count(program.err.begin(), program.err.end(), '\n'), 1) << program.err;
    EXPECT_FALSE(std::filesystem::exists(in("r.json"))) << outputs;
    EXPECT_FALSE(std::filesystem::exists(in("r.vtu"))) << outputs;
  }
  EXPECT_EQ(ReadWholeFile(folder / "bar.vtu"), mesh);
  EXPECT_EQ(ReadWholeFile(folder / "case.json"), tissue_case);
}

// The state that was reached is kept, but is marked as no answer.
TEST(SolveJob, AResultWithElementsInsideOutIsWrittenAsNotConvergedAndRefused) {
  for (const char* mode : {"static", "dynamic"}) {
    SolveRun run;
    auto crushed = BarCase();
    crushed["mode"] = mode;
    crushed["material"]["model"] = "corotated";
    crushed["material"]["poisson_ratio"] = 0;
    crushed["body_force"] = {-1e10, 3e9, 2e9};
    if (crushed["mode"] == "dynamic") crushed["dt"] = 0.01, crushed["steps"] = 3;
    Solve(run, crushed);
    EXPECT_EQ(run.program.exit_code, 1) << mode;
    EXPECT_NE(run.program.err.find("of 24 elements are turned inside out"), std::string::npos)
        << run.program.err;
    EXPECT_EQ(std::count(run.program.err.begin(), run.program.err.end(), '\n'), 1);
    EXPECT_EQ(run.json["converged"], false) << mode;
    EXPECT_GT(run.json["inverted_elements"], 0) << mode;
  }
}

TEST(SolveJob, AReferenceCaseAsAUserRunsIt) {
  ARTHRO_REQUIRE_SHARED(folder, "reference/tissue");
  const TempFolder temp;
  const std::string output = (temp / "result.json").string();
  const ProgramResult program =
      RunProgram("solve " + (folder / "cook_T10_S_snh.json").string() + " -o " + output);
  ASSERT_EQ(program.exit_code, 0) << program.err;
  std::ifstream stream(output);
  const auto json = nlohmann::json::parse(stream);
  // Discrete answer of that very mesh, from expected.json.
  const double tip = json["sets"]["tip"]["mean_displacement"][1];
  EXPECT_NEAR(tip / 0.0044177876, 1, 1e-6);
}

}  // namespace
}  // namespace arthro::test

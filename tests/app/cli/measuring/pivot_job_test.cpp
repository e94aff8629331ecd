#include <cmath>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "simulation/device/trace_io.h"
#include "simulation/scope/rod_pose.h"
#include "tests/support/run_program.h"
#include "tests/support/temp_folder.h"

namespace arthro::test {
namespace {

constexpr const char* kHeader = "hip_x,hip_y,hip_z,tip_x,tip_y,tip_z\n";

// A rod of 0.2 m through (0.01, 0.02, 0.1), `hand` behind it, swung by `angle` in the x-z plane.
std::string Row(double angle_deg, double hand = 0.12, double lift = 0.0) {
  const double a = angle_deg * std::acos(-1.0) / 180.0, x = std::sin(a), z = std::cos(a);
  return fmt::format("{},{},{},{},{},{}\n", 0.01 - hand * x, 0.02 + lift, 0.1 - hand * z,
                     0.01 + (0.2 - hand) * x, 0.02 + lift, 0.1 + (0.2 - hand) * z);
}

struct PivotRun {
  ProgramResult program;
  bool wrote = false;
  nlohmann::json json;
};

PivotRun RunPivot(const std::string& table, const std::string& flags = "") {
  const TempFolder folder;
  std::ofstream(folder / "poses.csv", std::ios::binary) << table;
  const std::string output = (folder / "pivot.json").string();
  PivotRun run;
  run.program =
      RunProgram("pivot " + (folder / "poses.csv").string() + " -o " + output + " " + flags);
  if (std::ifstream stream(output); stream) {
    run.wrote = true;
    run.json = nlohmann::json::parse(stream);
  }
  return run;
}

TEST(PivotJob, TwoCleanPressesGiveTheIncision) {
  const PivotRun run = RunPivot(kHeader + Row(-15) + Row(15));
  EXPECT_EQ(run.program.exit_code, 0) << run.program.err;
  ASSERT_TRUE(run.wrote);
  EXPECT_EQ(run.json["schema"], "arthroscene.pivot/1");
  EXPECT_EQ(run.json["status"], "ok");
  EXPECT_EQ(run.json["reason"], "");
  // The table holds doubles in full, so only their rounding is left.
  EXPECT_NEAR(run.json["pivot"][0].get<double>(), 0.01, 1e-14);
  EXPECT_NEAR(run.json["pivot"][1].get<double>(), 0.02, 1e-14);
  EXPECT_NEAR(run.json["pivot"][2].get<double>(), 0.1, 1e-14);
  EXPECT_EQ(run.json["poses_used"], 2);
  const double phi = std::acos(-1.0) / 6;
  EXPECT_NEAR(run.json["condition"].get<double>(), 1 / std::pow(std::sin(phi / 2), 2), 1e-9);
  EXPECT_NEAR(run.json["sigma"].get<double>(),
              0.055e-3 * std::sqrt(0.5 + 1 / (1 + std::cos(phi)) + 1 / (1 - std::cos(phi))), 1e-9);
  EXPECT_LT(run.json["residual"].get<double>(), 1e-14);
  EXPECT_EQ(run.json.size(), 8u);
}

TEST(PivotJob, WindowsLineEndsBlankLinesAndSpacesAreRead) {
  std::string table = "\xEF\xBB\xBF hip_x, hip_y,hip_z,tip_x,tip_y,tip_z\r\n" + Row(-15) + "\r\n";
  table += "  " + Row(15) + "\n\n";
  EXPECT_EQ(RunPivot(table).program.exit_code, 0);
}

struct Refusal {
  const char* status;
  std::string table;
  bool has_pivot;
};

// A refused calibration is a result: the record is written and the exit code is 1.
TEST(PivotJob, RefusedCalibrationsAreWrittenWithTheirStatus) {
  const Refusal refusals[] = {
      {"too_few", kHeader, false},
      {"too_few", kHeader + Row(10), false},
      {"too_narrow", kHeader + Row(10) + Row(10), false},
      {"too_narrow", kHeader + Row(-0.5) + Row(0.5), false},
      {"too_narrow", kHeader + Row(-2.5) + Row(2.5), false},
      {"inconsistent", kHeader + Row(-20) + Row(20, 0.12, 0.005), true},
      {"outside_rod", kHeader + Row(-20, 0.25) + Row(20, 0.25), true},
      {"outside_rod", kHeader + Row(-20, -0.05) + Row(20, -0.05), true},
  };
  for (const Refusal& refusal : refusals) {
    const PivotRun run = RunPivot(refusal.table);
    EXPECT_EQ(run.program.exit_code, 1) << refusal.table;
    ASSERT_TRUE(run.wrote) << refusal.table;
    EXPECT_EQ(run.json["status"], refusal.status) << refusal.table;
    EXPECT_EQ(run.json["pivot"].is_null(), !refusal.has_pivot) << refusal.table;
    EXPECT_GT(run.json["reason"].get<std::string>().size(), 20u);
    EXPECT_NE(run.program.err.find(refusal.status), std::string::npos) << run.program.err;
  }
}

TEST(PivotJob, OptionsAreFlags) {
  const std::string narrow = kHeader + Row(-2.5) + Row(2.5);
  EXPECT_EQ(RunPivot(narrow, "--min-spread-deg 4").program.exit_code, 0);
  EXPECT_EQ(RunPivot(narrow, "--min-spread-deg 4 --max-sigma-mm 0.5").program.exit_code, 1);
  EXPECT_EQ(RunPivot(narrow, "--min-spread-deg banana").program.exit_code, 2);
}

struct Malformed {
  std::string table, names;
};

// One sentence that names the line, exit code 1, nothing written.
TEST(PivotJob, MalformedTablesNameTheLine) {
  const Malformed tables[] = {
      {"", "line 1"},
      {"a,b\n", "line 1"},
      {Row(10) + Row(20), "line 1"},
      {kHeader + Row(10) + "1,2,3\n", "line 3"},
      {kHeader + Row(10) + "0,0,0,0,0,banana\n", "line 3"},
      {kHeader + Row(10) + "\n0,0,nan,0,0,0.2\n", "line 4"},
      {kHeader + std::string("0,0,0,0,0,inf\n"), "line 2"},
      {kHeader + std::string("0,0,0,0,0,1e999\n"), "line 2"},
      {kHeader + std::string("0,0,0,0,0,\n"), "line 2"},
      {kHeader + std::string("0,0,0,0,0,0\n"), "line 2"},
      {kHeader + std::string("0,0,0,0,0,0.2,7\n"), "line 2"},
      {kHeader + std::string("0,0,-150,0,0,50\n"), "line 2"},  // millimetres
      {std::string("\x89PNG\r\n\x1a\n\0\0\0", 11), "line 1"},
  };
  for (const Malformed& malformed : tables) {
    const PivotRun run = RunPivot(malformed.table);
    EXPECT_EQ(run.program.exit_code, 1) << malformed.table;
    EXPECT_FALSE(run.wrote) << malformed.table;
    EXPECT_NE(run.program.err.find(malformed.names + ":"), std::string::npos) << run.program.err;
    EXPECT_EQ(std::count(run.program.err.begin(), run.program.err.end(), '\n'), 1)
        << run.program.err;
  }
}

TEST(PivotJob, MissingTableAndBadUseAreTold) {
  const TempFolder folder;
  const std::string output = (folder / "pivot.json").string();
  const ProgramResult missing =
      RunProgram("pivot " + (folder / "none.csv").string() + " -o " + output);
  EXPECT_EQ(missing.exit_code, 1);
  EXPECT_NE(missing.err.find("none.csv"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(output));
  EXPECT_EQ(RunProgram("pivot").exit_code, 2);
  EXPECT_EQ(RunProgram("pivot --help").exit_code, 0);
}

// Ten seconds of swinging about (0.01, 0.02, 0.1) by the scope; by the instrument in and out alone.
TEST(PivotJob, AHandThatKeepsSwingingGivesTheIncision) {
  const TempFolder folder;
  const DeviceRig rig{{0.01, 0.02, 0.1}, {1, 0, 0, 0}, 0.2};
  std::vector<simulation::TraceRow> rows;
  for (int i = 0; i < 1000; ++i) {
    const double t = 0.01 * i;
    const simulation::RodPose swing{0.35 * std::sin(2.1 * t), 0.35 * std::sin(1.3 * t), t,
                                    0.08 + 0.02 * std::sin(0.7 * t)};
    const simulation::RodPose stroke{0.1, 0.1, 0, 0.08 + 0.02 * std::sin(t)};
    for (const auto& [role, pose] : {std::pair{simulation::DeviceRole::kScope, swing},
                                     {simulation::DeviceRole::kInstrument, stroke}})
      rows.push_back({role, {t, HipFromRodPose(pose, rig), HandleFromRodPose(pose, rig), 0, true}});
  }
  const std::string trace = (folder / "swing.csv").string();
  simulation::WriteTrace(trace, rows);
  const ProgramResult run = RunProgram("pivot " + trace + " --swing scope -o -");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const auto found = nlohmann::json::parse(run.out);
  EXPECT_EQ(found["status"], "ok");
  EXPECT_GT(found["poses_used"], 100);
  for (int axis : {0, 1, 2})
    EXPECT_NEAR(found["pivot"][axis].get<double>(), rig.pivot[axis], 1e-12);
  const ProgramResult narrow = RunProgram("pivot " + trace + " --swing instrument -o -");
  EXPECT_EQ(narrow.exit_code, 1);
  EXPECT_NE(narrow.err.find("too_narrow"), std::string::npos) << narrow.err;
  // A rod of a wrong length has its lines all the same: only where it ends is not known.
  EXPECT_EQ(RunProgram("pivot " + trace + " --swing scope --rod-length-mm 300 -o -").exit_code, 0);
  EXPECT_EQ(RunProgram("pivot " + trace + " --swing left -o -").exit_code, 2);
  EXPECT_EQ(RunProgram("pivot " + trace + " -o -").exit_code, 1) << "it is no table of presses";
}

TEST(PivotJob, StandardOutputTakesTheRecord) {
  const TempFolder folder;
  std::ofstream(folder / "poses.csv") << kHeader + Row(-15) + Row(15);
  const ProgramResult run = RunProgram("pivot " + (folder / "poses.csv").string() + " -o -");
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(nlohmann::json::parse(run.out)["status"], "ok");
}

}  // namespace
}  // namespace arthro::test

#include "simulation/practice/replay/replay.h"

#include <cmath>
#include <sstream>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "simulation/core/atomic_file.h"
#include "simulation/practice/scripted_device.h"
#include "simulation/scene/files/scene_io.h"
#include "simulation/scene/image_io.h"
#include "tests/support/run_program.h"
#include "tests/support/shapes.h"

namespace arthro::simulation {
namespace {

LoadedScene MakeScene() {
  LoadedScene loaded;
  loaded.scene.title = "flat";
  loaded.scene.backdrop.panorama = "panorama.png";
  loaded.scene.backdrop.depth = "depth.tiff";
  loaded.scene.backdrop.radius = 0.05;
  loaded.scene.backdrop.projection.centre_px = {127.5, 127.5};
  loaded.scene.backdrop.projection.focal_px = 120;
  loaded.scene.portals.incision_spacing = 0.03;
  loaded.panorama = Share(ColourImage(256, 256));
  loaded.depth = Share(DepthMap(256, 256, 0.004f));
  return loaded;
}

// Both hands stroke the backdrop; `rate` rows per second each.
std::vector<TraceRow> MakeTrace(double seconds, double rate) {
  ScriptedDevice scope({}), instrument({});
  std::vector<TraceRow> rows;
  for (int i = 0; i <= seconds * rate; ++i) {
    const double t = i / rate;
    scope.Set({0.2 * std::sin(t), 0.1 * t, t, 0.0465 + 0.001 * std::sin(3 * t)});
    instrument.Set({0.1 * std::sin(2 * t), -0.5, 0, 0.0535 + 0.0005 * std::sin(4 * t)});
    rows.push_back({DeviceRole::kScope, scope.Sample(t)});
    rows.push_back({DeviceRole::kInstrument, instrument.Sample(t)});
  }
  return rows;
}

std::vector<std::vector<std::string>> Table(const std::string& text) {
  std::vector<std::vector<std::string>> table;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    table.emplace_back();
    std::istringstream fields(line);
    for (std::string field; std::getline(fields, field, ',');) table.back().push_back(field);
  }
  return table;
}

// A shaver runs beside a loose implicit body, with its window towards it.
TEST(Replay, ReportsTheVolumeThatAShaverRemovesAndGivesTheSameBytesTwice) {
  LoadedScene loaded = MakeScene();
  loaded.depth = nullptr;
  Tissue tissue;
  tissue.name = "loose body";
  tissue.is_implicit = true;
  tissue.pose.position = {0.03, 0, 0.03};
  loaded.scene.tissues.push_back(tissue);
  loaded.surfaces.push_back(Share(test::Sphere({0, 0, 0}, 0.004, 4)));
  loaded.scene.instruments = {{"shaver", "shaver"}};
  std::vector<TraceRow> trace;
  ScriptedDevice instrument({});
  const double latitude = -std::asin(4.6 / 30);  // the rod passes 4.6 mm from its centre
  for (int i = 0; i < 300; ++i) {
    instrument.Set({latitude, 0, 0, std::min(0.033, 0.001 * i)});
    instrument.SetButtons(i > 50 ? 1 : 0);
    trace.push_back({DeviceRole::kInstrument, instrument.Sample(0.004 * i)});
  }
  ReplayReport first, second;
  const std::string forces = ForcesText(Replay(loaded, {trace, {}}, {}, {}, &first), loaded.scene);
  EXPECT_EQ(ForcesText(Replay(loaded, {trace, {}}, {}, {}, &second), loaded.scene), forces);
  ASSERT_EQ(first.tissues.size(), 1u);
  EXPECT_GT(first.tissues[0].cut.removed, 1e-9);
  EXPECT_EQ(first.tissues[0].cut.removed, second.tissues[0].cut.removed);
  const auto report = nlohmann::json::parse(ReportText(first, loaded.scene))["tissues"];
  EXPECT_EQ(report["loose body"]["removed_mm3"], first.tissues[0].cut.removed * 1e9);
}

TEST(Replay, GivesOneRowPerRowOfTheTrace) {
  const LoadedScene loaded = MakeScene();
  const auto trace = MakeTrace(0.5, 250);
  const auto forces = Replay(loaded, {trace, {}});
  ASSERT_EQ(forces.size(), trace.size());
  const auto table = Table(ForcesText(forces, loaded.scene));
  ASSERT_EQ(table.size(), trace.size() + 1);
  const std::vector<std::string> header{
      "t",      "device", "tip_x",  "tip_y", "tip_z", "force_x", "force_y",     "force_z",
      "hand_x", "hand_y", "hand_z", "u_px",  "v_px",  "contact", "penetration", "fault"};
  EXPECT_EQ(table[0], header);
  for (std::size_t i = 0; i < trace.size(); ++i) {
    EXPECT_EQ(std::stod(table[i + 1][0]), trace[i].sample.t);
    EXPECT_EQ(table[i + 1][1], ToString(trace[i].device));
    EXPECT_EQ(table[i + 1].size(), header.size());
  }
}

TEST(Replay, IsBitIdenticalOverThreeRuns) {
  const LoadedScene loaded = MakeScene();
  const auto trace = MakeTrace(2.0, 60);
  const std::string first = ForcesText(Replay(loaded, {trace, {}}), loaded.scene);
  EXPECT_GT(first.size(), 10000u);
  EXPECT_EQ(ForcesText(Replay(loaded, {trace, {}}), loaded.scene), first);
  EXPECT_EQ(ForcesText(Replay(loaded, {trace, {}}), loaded.scene), first);
}

// The tick rate does not depend on the rate of the recording; the hand is interpolated between
// rows.
TEST(Replay, ASlowRecordingGivesTheForcesOfAFastOne) {
  const LoadedScene loaded = MakeScene();
  const auto fast = Replay(loaded, {MakeTrace(2.0, 1000), {}}),
             slow = Replay(loaded, {MakeTrace(2.0, 100), {}});
  ASSERT_EQ(slow.size(), 402u);
  double worst = 0;
  for (std::size_t i = 0; i < slow.size(); ++i) {
    const ForceRow& same = fast[i / 2 * 20 + i % 2];
    ASSERT_NEAR(same.t, slow[i].t, 1e-12);
    worst = std::max(worst, glm::length(same.state.tip_force - slow[i].state.tip_force));
    EXPECT_EQ(slow[i].state.fault, Fault::kNone);
  }
  std::printf("100 rows per second against 1000: force differs by %.1e N at worst\n", worst);
  EXPECT_LT(worst, 0.01);
}

TEST(Replay, ReportAddsUp) {
  const LoadedScene loaded = MakeScene();
  ReplayReport report;
  const auto forces = Replay(loaded, {MakeTrace(2.0, 100), {}}, {}, {}, &report);
  EXPECT_NEAR(report.duration, 2.0, 1e-12);
  EXPECT_EQ(report.ticks, 2001);
  const HandReport& scope = report.hand[0];
  EXPECT_EQ(scope.rows, 201);
  double peak = 0;
  for (const ForceRow& row : forces)
    if (row.device == DeviceRole::kScope) peak = std::max(peak, glm::length(row.state.tip_force));
  EXPECT_GE(scope.peak_force, peak);
  EXPECT_GT(scope.mean_force, 0.0);
  EXPECT_LE(scope.mean_force, scope.peak_force);
  EXPECT_NEAR(scope.contact.at(kBackdropContact), scope.time_in_contact, 1e-9);
  const auto json = nlohmann::json::parse(ReportText(report, loaded.scene));
  EXPECT_EQ(json.at("schema"), "arthroscene.replay/1");
  EXPECT_EQ(json.at("devices").at("scope").at("rows"), 201);
  EXPECT_TRUE(json.at("devices").at("scope").at("contacts").contains("backdrop"));
  EXPECT_GT(json.at("tick_us").at("median"), 0.0);
}

TEST(Replay, ReportsTheRemovedVolumePerRegion) {
  LoadedScene loaded = MakeScene();
  Tissue& tissue = loaded.scene.tissues.emplace_back();
  tissue.name = "meniscus";
  tissue.regions = {{"anterior horn", {}}, {"posterior horn", {}}};
  loaded.scene.tissues.emplace_back().name = "labrum";
  ReplayReport report;
  report.tissues.resize(2);
  report.tissues[0].cut = {6e-9, 1, 0, 0, 3, {1e-9, 2e-9, 3e-9}, {}};
  report.tissues[1].tissue = 1;
  const auto json = nlohmann::json::parse(ReportText(report, loaded.scene)).at("tissues");
  const auto& parts = json.at("meniscus").at("removed_mm3_by_region");
  EXPECT_EQ(parts.size(), 3u);
  EXPECT_NEAR(parts.at("anterior horn"), 1.0, 1e-12);
  EXPECT_NEAR(parts.at("posterior horn"), 2.0, 1e-12);
  EXPECT_NEAR(parts.at("elsewhere"), 3.0, 1e-12);
  EXPECT_FALSE(json.at("labrum").contains("removed_mm3_by_region"));
}

// The name of a tissue may contain any characters.
TEST(Replay, ContactNamesAreQuotedWhereNeeded) {
  LoadedScene loaded = MakeScene();
  Tissue tissue;
  tissue.name = "medial, \"torn\"";
  loaded.scene.tissues.push_back(tissue);
  ForceRow row;
  row.state.contact = 1;
  const std::string text = ForcesText({row}, loaded.scene);
  EXPECT_NE(text.find(",\"medial, \"\"torn\"\"\","), std::string::npos) << text;
}

// Runs the job as a user does.
class ReplayJob : public testing::Test {
 protected:
  void SetUp() override {
    const LoadedScene loaded = MakeScene();
    WriteColourImage(folder_ / "panorama.png", *loaded.panorama);
    WriteDepthMap(folder_ / "depth.tiff", *loaded.depth);
    WriteScene(folder_ / "scene.json", loaded.scene);
    WriteTrace(folder_ / "trace.csv", MakeTrace(0.5, 100));
  }
  std::string Path(const std::string& name) const { return (folder_ / name).string(); }
  test::ProgramResult Run(const std::string& rest) const {
    return test::RunProgram("replay " + folder_.path().string() + " " + rest);
  }
  test::TempFolder folder_;
};

TEST_F(ReplayJob, WritesForcesAndReport) {
  const auto result =
      Run(Path("trace.csv") + " -o " + Path("f.csv") + " --report " + Path("r.json"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto table = Table(ReadWholeFile(folder_ / "f.csv"));
  EXPECT_EQ(table.size(), 103u);
  EXPECT_EQ(nlohmann::json::parse(ReadWholeFile(folder_ / "r.json")).at("ticks"), 501);
  // Standard output gives the same text, and so does a second run.
  const auto printed = Run(Path("trace.csv") + " -o -");
  EXPECT_EQ(printed.exit_code, 0) << printed.err;
  EXPECT_EQ(printed.out, ReadWholeFile(folder_ / "f.csv"));
}

TEST_F(ReplayJob, StiffnessIsAnOption) {
  ASSERT_EQ(Run(Path("trace.csv") + " -o " + Path("a.csv") + " --damping 0").exit_code, 0);
  ASSERT_EQ(
      Run(Path("trace.csv") + " -o " + Path("b.csv") + " --damping 0 --stiffness 250").exit_code,
      0);
  const auto a = Table(ReadWholeFile(folder_ / "a.csv")),
             b = Table(ReadWholeFile(folder_ / "b.csv"));
  EXPECT_NEAR(std::stod(a.back()[7]), 2 * std::stod(b.back()[7]), 1e-6);
  EXPECT_EQ(Run(Path("trace.csv") + " -o " + Path("c.csv") + " --stiffness 1e9").exit_code, 2);
}

TEST_F(ReplayJob, AnInvalidHandPositionGivesAFaultAndNoForce) {
  WriteAtomically(folder_ / "far.csv",
                  std::string_view("t,device,hip_x,hip_y,hip_z,qw,qx,qy,qz,buttons\n"
                                   "0,scope,0,0,-0.15,1,0,0,0,0\n"
                                   "0.01,scope,1e300,0,0,1,0,0,0,0\n"
                                   "0.02,scope,1e300,0,0,1,0,0,0,0\n"));
  ASSERT_EQ(Run(Path("far.csv") + " -o " + Path("f.csv")).exit_code, 0);
  const auto table = Table(ReadWholeFile(folder_ / "f.csv"));
  ASSERT_EQ(table.size(), 4u);
  for (std::size_t row : {2u, 3u}) {
    EXPECT_EQ(table[row].back(), "too_far");
    for (int column = 5; column <= 10; ++column)
      EXPECT_EQ(std::stod(table[row][static_cast<std::size_t>(column)]), 0.0) << column;
  }
}

TEST_F(ReplayJob, RefusesABadTraceWithItsLineAndWritesNothing) {
  WriteAtomically(folder_ / "bad.csv",
                  std::string_view("t,device,hip_x,hip_y,hip_z,qw,qx,qy,qz,buttons\n"
                                   "0,scope,0,0,-0.17,1,0,0,0,0\n"
                                   "0.001,scope,nan,0,-0.17,1,0,0,0,0\n"));
  WriteAtomically(folder_ / "f.csv", std::string_view("before"));
  const auto result = Run(Path("bad.csv") + " --overwrite -o " + Path("f.csv"));
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.err.find("bad.csv: line 3: hip_x"), std::string::npos) << result.err;
  EXPECT_EQ(ReadWholeFile(folder_ / "f.csv"), "before");
  EXPECT_EQ(Run(Path("missing.csv") + " --overwrite -o " + Path("f.csv")).exit_code, 1);
  EXPECT_EQ(Run(Path("trace.csv")).exit_code, 2) << "-o is required";
  const std::string trace = ReadWholeFile(folder_ / "trace.csv");
  EXPECT_EQ(Run(Path("trace.csv") + " -o " + Path("trace.csv")).exit_code, 1);
  EXPECT_EQ(ReadWholeFile(folder_ / "trace.csv"), trace) << "its input is not its output";
}

}  // namespace
}  // namespace arthro::simulation

#include "simulation/training/assessment.h"

#include <cmath>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

#include "simulation/practice/scripted_device.h"

namespace arthro::simulation {
namespace {

// A sphere of 50 mm without tissue.
LoadedScene BareSphere() {
  LoadedScene loaded;
  loaded.scene.title = "sphere";
  loaded.scene.backdrop.radius = 0.05;
  loaded.scene.backdrop.projection.centre_px = {127.5, 127.5};
  loaded.scene.backdrop.projection.focal_px = 120;
  loaded.scene.portals.incision_spacing = 0.03;
  loaded.panorama = Share(ColourImage(256, 256));
  return loaded;
}

// The instrument swings twice by 0.3 rad to each side in 8 s, 20 mm deep; then it is pressed on the
// wall and leaves it again within 2 s.
std::vector<TraceRow> SwingAndPress(const LoadedScene& loaded) {
  ScriptedDevice instrument(loaded.scene.rig.instrument);
  std::vector<TraceRow> rows;
  for (int i = 0; i <= 10 * 250; ++i) {
    const double t = i / 250.0;
    const double press = t > 8 ? std::sin(kRadianPerTurn * (t - 8) / 4) : 0.0;
    instrument.Set(
        {0, t > 8 ? 0.0 : 0.3 * std::sin(kRadianPerTurn * t / 4), 0, 0.02 + 0.0205 * press});
    rows.push_back({DeviceRole::kInstrument, instrument.Sample(t)});
  }
  return rows;
}

double ValueOf(const Assessment& assessment, std::string_view id, std::string_view part) {
  for (const MetricValue& value : assessment.values)
    if (value.metric->id == id && value.part == part && value.value) return *value.value;
  ADD_FAILURE() << "no value of " << id << " of " << part;
  return 0;
}

TEST(Assessment, MeasuresRecordedHands) {
  const LoadedScene loaded = BareSphere();
  const auto trace = SwingAndPress(loaded);
  const Assessment assessment = Assess(loaded, {trace, {}});
  EXPECT_EQ(assessment.frames.size(), 1000U);
  EXPECT_NEAR(assessment.duration, 10, 1e-9);
  EXPECT_NEAR(ValueOf(assessment, "task_time", "both"), 10, 1e-9);
  // Two swings of four quarters each; an arc of 20 mm; in and out by 20.5 mm.
  EXPECT_NEAR(ValueOf(assessment, "turn", "instrument"), 2 * 4 * 0.3, 0.01);
  EXPECT_NEAR(ValueOf(assessment, "path", "instrument"), 0.02 * 2.4 + 2 * 0.0205, 5e-4);
  EXPECT_NEAR(ValueOf(assessment, "depth_path", "instrument"), 2 * 0.0205, 5e-4);
  EXPECT_EQ(ValueOf(assessment, "contacts", "instrument on backdrop"), 1);
  ReplayReport replay;
  Replay(loaded, {trace, {}}, {}, {}, &replay);
  const HandReport& hand = replay.hand[Index(DeviceRole::kInstrument)];
  EXPECT_GT(hand.peak_force, 0.1);
  EXPECT_NEAR(ValueOf(assessment, "peak_force", "instrument"), hand.peak_force, 1e-5);
  EXPECT_NEAR(ValueOf(assessment, "mean_force", "instrument"), hand.mean_force,
              1e-4 * hand.mean_force);
  EXPECT_NEAR(ValueOf(assessment, "contact_time", "instrument on backdrop"), hand.time_in_contact,
              1e-4);
}

TEST(Assessment, SaysWhatTheScopeDidNot) {
  const LoadedScene loaded = BareSphere();
  const Assessment assessment = Assess(loaded, {SwingAndPress(loaded), {}});
  std::set<std::string> missing;
  for (const MetricValue& value : assessment.values)
    if (value.part == "scope" && !value.value) {
      missing.insert(std::string(value.metric->id));
      EXPECT_FALSE(value.why_none.empty()) << value.metric->id;
    }
  for (const char* id : {"path", "turn", "sparc", "peak_force"}) EXPECT_TRUE(missing.contains(id));
}

TEST(Assessment, GivesTheSameBitsAgain) {
  const LoadedScene loaded = BareSphere();
  const auto trace = SwingAndPress(loaded);
  EXPECT_TRUE(Assess(loaded, {trace, {}}).values == Assess(loaded, {trace, {}}).values);
}

}  // namespace
}  // namespace arthro::simulation

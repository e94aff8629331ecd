// A recorded practice, played again with all that its trainee chose.
#include <cmath>
#include <optional>

#include <gtest/gtest.h>

#include "simulation/core/units.h"
#include "simulation/device/log/log_replay.h"
#include "simulation/practice/hands/practice.h"
#include "simulation/practice/replay.h"
#include "tests/support/shapes.h"
#include "tests/support/temp_folder.h"

namespace arthro::simulation {
namespace {

constexpr double kFrame = 1.0 / 60;

// A loose body of 4 mm, 30 mm in front of the instrument's portal; the scene begins with the probe.
LoadedScene LooseBody() {
  LoadedScene loaded;
  loaded.scene.title = "loose body";
  loaded.scene.backdrop.radius = 0.05;
  loaded.scene.backdrop.projection.centre_px = {127.5, 127.5};
  loaded.scene.backdrop.projection.focal_px = 120;
  loaded.scene.portals.incision_spacing = 0.03;
  loaded.panorama = Share(ColourImage(256, 256));
  Tissue tissue;
  tissue.name = "loose body";
  tissue.is_implicit = true;
  tissue.pose.position = {0.03, 0, 0.03};
  loaded.scene.tissues.push_back(tissue);
  loaded.surfaces.push_back(Share(test::Sphere({0, 0, 0}, 0.004, 4)));
  return loaded;
}

class LoggedWishes : public testing::Test {
 protected:
  void SetUp() override {
    HandsChoice choice;
    choice.log = folder / "practice.log";
    hands.emplace(choice);
    practice.emplace(MakePractice(loaded, {}, TissuePace::kInline));
  }
  void Frames(int count) {
    for (int i = 0; i < count; ++i) practice->Advance(kFrame, &*hands);
  }
  // Leads the instrument along a rod that passes 4.6 mm from the middle of the body.
  void Lead(double depth, int frames) {
    practice->instrument().Set({-std::asin(4.6 / 30), 0, 0, depth});
    Frames(frames);
  }
  Recording End() {
    practice.reset();
    EXPECT_EQ(hands->End(), "");
    return RecordingOf(ReadDeviceLog(folder / "practice.log"));
  }

  test::TempFolder folder;
  const LoadedScene loaded = LooseBody();
  std::optional<Hands> hands;
  std::optional<Practice> practice;
};

TEST_F(LoggedWishes, ShaverRemovesTheSameAgain) {
  Lead(0.02, 20);
  practice->SetInstrument(ToolKind::kShaver);
  Lead(0.033, 40);
  practice->Press(true);
  Frames(60);
  const double removed = practice->tissues()->bodies.at(0).cut.removed;
  ASSERT_GT(removed, 1e-9);
  const Recording recording = End();
  ReplayReport again, without;
  Replay(loaded, recording, {}, {}, &again);
  EXPECT_NEAR(again.tissues.at(0).cut.removed, removed, 0.02 * removed);
  Replay(loaded, {recording.rows, {}}, {}, {}, &without);
  EXPECT_TRUE(without.tissues.empty() || without.tissues[0].cut.removed == 0)
      << "the probe that the scene begins with removes nothing";
}

TEST_F(LoggedWishes, ViewAngleChangesWhenItDid) {
  Frames(30);
  practice->SetViewAngle(RadiansFromDegrees(70));
  Frames(30);
  EXPECT_EQ(practice->snapshot().view_angle, RadiansFromDegrees(70));
  const Recording recording = End();
  ASSERT_EQ(recording.wishes.size(), 2u) << "one at the beginning, and one at the change";
  double changed = -1;
  Replay(loaded, recording, {}, {}, nullptr, {},
         [&](double t, const Snapshot& snapshot, ToolKind, const WorldPicture*) {
           if (changed < 0 && snapshot.view_angle > 1) changed = t;
         });
  EXPECT_NEAR(changed, 0.5, 2e-3) << "to two ticks";
}

TEST_F(LoggedWishes, ResetMakesTheTissueWholeAgain) {
  practice->SetInstrument(ToolKind::kShaver);
  Lead(0.033, 40);
  practice->Press(true);
  Frames(60);
  practice->Press(false);
  Lead(0.01, 30);
  practice->ResetTissues();
  Frames(10);
  ASSERT_EQ(practice->tissues()->bodies.at(0).cut.removed, 0);
  ReplayReport again;
  Replay(loaded, End(), {}, {}, &again);
  EXPECT_EQ(again.tissues.at(0).cut.removed, 0);
}

TEST_F(LoggedWishes, NothingIsLoggedWhileNothingChanges) {
  Frames(120);
  EXPECT_EQ(End().wishes.size(), 1u);
}

}  // namespace
}  // namespace arthro::simulation

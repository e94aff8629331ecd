// A recorded practice, played again with all that its trainee chose.
#include <cmath>
#include <optional>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/core/units.h"
#include "simulation/device/log/log_replay.h"
#include "simulation/practice/hands/practice.h"
#include "simulation/practice/replay/option_numbers.h"
#include "simulation/practice/replay/replay.h"
#include "tests/support/shapes.h"
#include "tests/support/temp_folder.h"
#include "tests/support/ticks.h"

namespace arthro::simulation {
namespace {

using test::kFrame;

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
  // Presses the front of the body, 26 mm from the portal.
  void PressTheBody() {
    practice->instrument().Set({0, 0, 0, 0.0275});
    Frames(60);
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
  Replay(loaded, {recording.rows}, {}, {}, &without);
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
         [&](double t, const Snapshot& snapshot, const WorldPicture*) {
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

TEST_F(LoggedWishes, CameraHeadAndDisturbancesFollow) {
  Frames(30);
  practice->SetCameraHead({.is_upright = true, .turn = 0.4});
  Disturbances murky;
  murky.haze = 0.6;
  murky.overexposure = 0.2;
  murky.seed = 5;
  practice->SetDisturbances(murky);
  Frames(30);
  EXPECT_EQ(practice->snapshot().disturbances, murky);
  Snapshot first, last;
  Replay(loaded, End(), {}, {}, nullptr, {},
         [&](double t, const Snapshot& snapshot, const WorldPicture*) {
           if (t < 0.4) first = snapshot;
           last = snapshot;
         });
  EXPECT_EQ(first.head, CameraHead());
  EXPECT_EQ(first.disturbances, Disturbances());
  EXPECT_EQ(last.head, (CameraHead{true, 0.4}));
  EXPECT_EQ(last.disturbances, murky);
}

TEST_F(LoggedWishes, MountFollows) {
  Frames(30);
  DeviceRig mount = loaded.scene.rig.instrument;
  mount.pivot = {0.002, -0.001, 0.0005};
  mount.rod_length = 0.19;
  practice->SetMount(DeviceRole::kInstrument, mount);
  Lead(0.02, 60);
  const glm::dvec3 tip = practice->snapshot().instrument.tip_in_portal;
  Snapshot last;
  Replay(loaded, End(), {}, {}, nullptr, {},
         [&](double, const Snapshot& snapshot, const WorldPicture*) { last = snapshot; });
  EXPECT_NEAR(glm::distance(last.instrument.tip_in_portal, tip), 0, 1e-9);
}

// A rig whose punch is 12 mm longer than its rod: with the hand held still, the tip lies deeper
// while the punch is held, its force is that of the deeper tip, and the replay has both.
TEST_F(LoggedWishes, TipOffsetOfTheInstrumentFollows) {
  constexpr double kLonger = 0.012;  // m
  const auto press_with = [&](double beyond) {
    HandsChoice choice;
    choice.log = folder / ("tips-" + std::to_string(beyond) + ".log");
    RigRole& role = choice.rig.emplace().instrument.emplace();
    role.mount = loaded.scene.rig.instrument;
    role.tip_offsets.beyond_rod[1] = beyond;
    // Recorded hands on the mounts of the rig: a hand that holds still.
    const RodPose at{0, 0, 0, 0.0275 - kLonger};
    for (const double t : {0.0, 10.0})
      choice.trace.push_back(
          {DeviceRole::kInstrument,
           {t, HipFromRodPose(at, role.mount), HandleFromRodPose(at, role.mount), 0, true}});
    Hands own(choice);
    Practice still = MakePractice(loaded, {}, TissuePace::kInline);
    const auto frames = [&](int count) {
      for (int i = 0; i < count; ++i) still.Advance(kFrame, &own);
    };
    frames(60);
    EXPECT_NEAR(still.snapshot().instrument.tip_in_portal.z, 0.0275 - kLonger, 1e-9);
    still.SetInstrument(ToolKind::kPunch);
    frames(60);
    return std::pair{still.snapshot().instrument.pose.depth,
                     glm::length(still.snapshot().instrument.tip_force)};
  };
  const auto [depth, force] = press_with(kLonger);
  EXPECT_NEAR(depth, 0.0275, 1e-9);
  EXPECT_GT(force, 0.05) << "it presses on the body, 26 mm from the portal";
  const auto [plain_depth, plain_force] = press_with(0);
  EXPECT_NEAR(plain_depth, 0.0275 - kLonger, 1e-9);
  EXPECT_EQ(plain_force, 0);

  Recording recording =
      RecordingOf(ReadDeviceLog(folder / ("tips-" + std::to_string(kLonger) + ".log")));
  Snapshot last;
  Replay(loaded, recording, {}, {}, nullptr, {},
         [&](double, const Snapshot& snapshot, const WorldPicture*) { last = snapshot; });
  EXPECT_NEAR(last.instrument.pose.depth, depth, 1e-9);
}

TEST_F(LoggedWishes, OptionsFollowAndThoseOfTheCallerTakePrecedence) {
  SessionOptions soft;
  soft.contact.stiffness = 150;
  soft.limiter.max_force = 1.5;
  practice.emplace(MakePractice(loaded, {}, TissuePace::kInline, soft));
  PressTheBody();
  const double force = glm::length(practice->snapshot().instrument.tip_force);
  ASSERT_GT(force, 0.02);
  const Recording recording = End();
  const auto last_force = [&](const SessionOptions& options) {
    Snapshot last;
    Replay(loaded, recording, options, {}, nullptr, {},
           [&](double, const Snapshot& snapshot, const WorldPicture*) { last = snapshot; });
    return glm::length(last.instrument.tip_force);
  };
  EXPECT_NEAR(last_force({}), force, 1e-3 * force);
  SessionOptions stiff;
  stiff.contact.stiffness = 300;
  EXPECT_GT(last_force(stiff), 1.5 * force);
}

TEST_F(LoggedWishes, OptionThatChangesMidwayFollows) {
  PressTheBody();
  SessionOptions soft;
  soft.contact.stiffness = 100;
  practice->SetOptions(soft, nullptr);
  Frames(60);
  const double force = glm::length(practice->snapshot().instrument.tip_force);
  double before = 0, after = 0;
  Replay(loaded, End(), {}, {}, nullptr, {},
         [&](double t, const Snapshot& snapshot, const WorldPicture*) {
           (t < 0.95 ? before : after) = glm::length(snapshot.instrument.tip_force);
         });
  EXPECT_NEAR(after, force, 1e-3 * force);
  EXPECT_GT(before, 2 * after);
}

TEST_F(LoggedWishes, GapOfMinutesBetweenTwoAttemptsIsPlayed) {
  Lead(0.02, 60);
  Recording recording = End();
  const std::size_t half = recording.rows.size() / 2;
  for (std::size_t i = half; i < recording.rows.size(); ++i) recording.rows[i].sample.t += 600;
  ReplayReport report;
  const auto forces = Replay(loaded, recording, {}, {}, &report);
  EXPECT_EQ(forces.size(), recording.rows.size());
  EXPECT_GT(report.duration, 600);
  EXPECT_LT(report.ticks, 62000) << "ticks of a minute of the gap, not of all of it";
}

TEST_F(LoggedWishes, WatchesAreCalledWhileTheyAreAdded) {
  struct Count final : ServoWatch {
    long ticks = 0;
    void AfterTick(const Snapshot&, double) noexcept override { ++ticks; }
  } early, late;
  practice->AddWatch(early);
  Frames(6);
  EXPECT_EQ(early.ticks, 100);
  practice->AddWatch(late);
  practice->RemoveWatch(early);
  Frames(6);
  EXPECT_EQ(early.ticks, 100);
  EXPECT_EQ(late.ticks, 100);
}

TEST_F(LoggedWishes, NothingIsLoggedWhileNothingChanges) {
  Frames(120);
  const Recording recording = End();
  EXPECT_EQ(recording.wishes.size(), 1u);
  EXPECT_EQ(static_cast<int>(recording.options.size()), NumbersOf({}).count);
}

}  // namespace
}  // namespace arthro::simulation

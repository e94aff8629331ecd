// An attempt while it runs, and the same one from its log.
#include "simulation/training/observe/live_attempt.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "simulation/device/recorded_device.h"
#include "simulation/practice/living_tissues.h"
#include "simulation/training/assessment.h"
#include "simulation/training/attempt_log.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/shapes.h"
#include "tests/support/temp_folder.h"

namespace arthro::simulation {
namespace {

// A loose body of 4 mm in a bare sphere, which a shaver can take away.
LoadedScene LooseBody() {
  LoadedScene loaded;
  loaded.scene.backdrop.radius = 0.05;
  loaded.scene.backdrop.projection.centre_px = {63.5, 63.5};
  loaded.scene.backdrop.projection.focal_px = 60;
  loaded.scene.portals.incision_spacing = 0.03;
  loaded.panorama = Share(ColourImage(128, 128));
  Tissue tissue;
  tissue.name = "loose body";
  tissue.is_implicit = true;
  tissue.pose.position = {0.012, 0, 0.028};
  loaded.scene.tissues.push_back(tissue);
  loaded.surfaces.push_back(Share(test::Sphere({0, 0, 0}, 0.004, 2)));
  return loaded;
}

// Hands that wander about the body, one row every 4 ms.
std::vector<TraceRow> Wandering(std::mt19937& random, double duration, const Scene& scene) {
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution(low, high)(random);
  };
  const double phase = uniform(0, 6), speed = uniform(2, 9);
  std::vector<TraceRow> rows;
  const auto add = [&](double t, DeviceRole role, const RodPose& pose, bool is_pressed) {
    const DeviceRig& rig = role == DeviceRole::kScope ? scene.rig.scope : scene.rig.instrument;
    TraceRow row;
    row.device = role;
    row.sample.t = t;
    row.sample.hip_in_device = HipFromRodPose(pose, rig);
    row.sample.handle_in_device = HandleFromRodPose(pose, rig);
    row.sample.buttons = is_pressed ? 1 : 0;
    row.sample.valid = true;
    rows.push_back(row);
  };
  for (double t = 0; t < duration; t += 0.004) {
    const double s = std::sin(speed * t + phase), c = std::cos(1.3 * speed * t);
    add(t, DeviceRole::kScope, {-0.2 + 0.1 * s, 0.3 + 0.2 * c, s, 0.01 + 0.004 * c}, false);
    add(t, DeviceRole::kInstrument, {0.05 * c, -0.55 + 0.08 * s, c, 0.031 + 0.003 * s}, s > 0);
  }
  return rows;
}

struct BothWays {
  std::vector<AttemptFrame> live;
  RecordedAttempt offline;
  double removed = 0;  // m³
};

BothWays Attempt(const LoadedScene& loaded, int seed, double duration, TissuePace pace) {
  std::mt19937 random(static_cast<unsigned>(seed));
  Session session(loaded);
  EnlivenTissues(session, loaded, {}, pace);
  const auto rows = Wandering(random, duration, loaded.scene);
  RecordedDevice scope(rows, DeviceRole::kScope), instrument(rows, DeviceRole::kInstrument);
  ScopeEye eye(loaded);
  LiveAttempt attempt(
      loaded,
      {*TargetOnBearing(loaded, -0.1, 0.2, 2e-3), *TargetOnTissue(loaded, 0, {0, 0, -0.004}, 2e-3),
       TargetInBall({0.01, 0, 0.02}, 3e-3)},
      session.relief(), eye);
  ServoOptions options;
  options.period_without_force = kServoPeriod;
  options.watches = {&attempt.watch()};
  ServoLoop servo(session, &scope, &instrument, options);
  ServoRequest request{session.options(),
                       session.incision_spacing(),
                       session.view_angle(),
                       {},
                       {},
                       ToolKind::kShaver,
                       {},
                       false,
                       {}};
  request.head.is_upright = seed % 2 == 0;
  request.disturbances.haze = 0.1 * (seed % 4);
  servo.SetRequest(request);
  const test::TempFolder folder;
  AttemptLog log(folder / "a.attempt", std::vector<LogSource>{{"", "", "1", {}}}, "{}");
  BothWays both;
  double t = 0;
  while (t < duration) {
    // A window that draws at a rate of its own, and is sometimes late.
    const int ticks = 1 + static_cast<int>(random() % 40);
    for (int i = 0; i < ticks; ++i) servo.TickOnce(t += kServoPeriod);
    if (random() % 9 == 0) attempt.watch().SetPaused(random() % 2 == 0);
    const WorldPicture* world = session.tissues();
    if (world != nullptr) eye.Follow(*world);
    eye.MoveTo(session.snapshot().scope);
    for (const AttemptFrame& frame : attempt.Update(world)) {
      both.live.push_back(frame);
      log.Add(frame);
    }
  }
  for (const BodyPicture& body : session.tissues()->bodies) both.removed += body.cut.removed;
  log.Close();
  both.offline = ReadAttempt(folder / "a.attempt");
  return both;
}

TEST(LiveAttempt, IsTheSameFromItsLogInTwoHundredSessions) {
  const LoadedScene loaded = LooseBody();
  long frames = 0, seen = 0, cut = 0;
  for (int seed = 0; seed < 200; ++seed) {
    const BothWays both = Attempt(loaded, seed, 0.4, TissuePace::kInline);
    ASSERT_EQ(both.live, both.offline.frames) << "session " << seed;
    ASSERT_TRUE(AssessFrames(both.live, loaded.scene).values ==
                AssessFrames(both.offline.frames, loaded.scene).values);
    frames += static_cast<long>(both.live.size());
    for (const AttemptFrame& frame : both.live)
      for (const PointSight& sight : frame.sight.target) seen += sight.is_clear;
    cut += both.removed > 0;
  }
  EXPECT_GE(frames, 200 * 39);
  EXPECT_GT(seen, 1000);
  EXPECT_GT(cut, 20) << "sessions that shaved some of the body away";
}

TEST(LiveAttempt, IsTheSameFromItsLogWithTissueOnItsOwnThread) {
  const LoadedScene loaded = LooseBody();
  const BothWays both = Attempt(loaded, 1, 2.0, TissuePace::kThread);
  EXPECT_EQ(both.live, both.offline.frames);
  EXPECT_GE(both.live.size(), 199U);
}

TEST(LiveAttempt, TakenTissueIsThatOfTheSession) {
  const LoadedScene loaded = LooseBody();
  for (int seed = 0; seed < 10; ++seed) {
    const BothWays both = Attempt(loaded, seed, 0.4, TissuePace::kInline);
    double taken = 0;
    for (const AttemptFrame& frame : both.live) taken += frame.taken;
    // Frames hold 32 bits.
    EXPECT_NEAR(taken, both.removed, 1e-5 * both.removed);
  }
}

TEST(LiveFrames, TickAllocatesNothingAndAFullQueueKeepsTheTime) {
  LiveFrames frames;
  Snapshot snapshot;
  snapshot.scope.pose.depth = 0.01;
  snapshot.scope.fault = Fault::kNone;
  const long before = test::Allocations();
  for (int i = 0; i < 8000; ++i) {
    snapshot.t += 0.001;
    frames.AfterTick(snapshot, 0.001);
  }
  EXPECT_EQ(test::Allocations(), before);
  AttemptFrame frame;
  long valid = 0, all = 0;
  for (; frames.Take(frame); ++all) valid += frame.tool[0].is_valid;
  EXPECT_EQ(all, 500) << "as many as there is room for";
  for (int i = 0; i < 100; ++i) {
    snapshot.t += 0.001;
    frames.AfterTick(snapshot, 0.001);
  }
  for (; frames.Take(frame); ++all) valid += frame.tool[0].is_valid;
  EXPECT_EQ(all, 809) << "frames that were lost take their place";
  EXPECT_EQ(valid, 510);
}

}  // namespace
}  // namespace arthro::simulation

// Metrics of hands that need no exercise, from frames that are made up one by one, against closed
// forms.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/simulation/training/metrics/measured_value.h"

namespace arthro::simulation {
namespace {

using test::ValueIn;

constexpr DeviceRole kHand = DeviceRole::kInstrument;

const std::vector<std::string> kTwoSurfaces = {"backdrop", "meniscus"};

AttemptFrame OutsideFrame() {
  AttemptFrame frame = test::QuietFrame();
  for (ToolFrame& tool : frame.tool) tool.depth = -0.001F;
  return frame;
}

AttemptFrame PausedFrame() {
  AttemptFrame frame = test::QuietFrame();
  frame.is_paused = true;
  return frame;
}

// Share: frames in stretches of at least three in the joint, per frames without a pause.
TEST(HandMetrics, MeasuredShareCountsStretchesInTheJoint) {
  AttemptFrame unknown = test::QuietFrame();
  for (ToolFrame& tool : unknown.tool) tool.is_valid = false;
  std::vector<AttemptFrame> frames;
  test::Append(frames, 300, test::QuietFrame());
  test::Append(frames, 100, OutsideFrame());
  test::Append(frames, 2, test::QuietFrame());
  test::Append(frames, 98, OutsideFrame());
  test::Append(frames, 200, test::QuietFrame());
  test::Append(frames, 100, unknown);
  test::Append(frames, 200, PausedFrame());
  const auto values = MeasureAttempt(frames, {});
  EXPECT_NEAR(ValueIn(values, "task_time", "both"), 8, 1e-9);
  for (const char* part : {"scope", "instrument"})
    EXPECT_NEAR(ValueIn(values, "measured_share", part), 500.0 / 800, 1e-12) << part;
}

// The tip goes 0.1 mm per frame, at 60° to the rod: the way along the rod is cos 60° of the path.
// Rod and roll turn by 0.01 rad per frame.
TEST(HandMetrics, WaysAddUpOverStretchesAndNotAcrossAPause) {
  const double slope = std::numbers::pi / 3;
  auto frames = test::FramesOfTip(201, kHand, [&](int k) {
    const double way = 1e-4 * k + (k > 100 ? 0.05 : 0.0);  // a jump of 50 mm in the pause
    return way * glm::dvec3(std::sin(slope), 0, std::cos(slope));
  });
  for (std::size_t k = 0; k < frames.size(); ++k) {
    ToolFrame& scope = frames[k].tool[Index(DeviceRole::kScope)];
    const double turn = 0.01 * static_cast<double>(k) + (k > 100 ? 1.0 : 0.0);
    scope.axis = glm::vec3(std::cos(turn), 0, std::sin(turn));
    scope.roll = static_cast<float>(k % 2 == 0 ? turn : -turn);
  }
  frames[100].is_paused = true;
  const auto values = MeasureAttempt(frames, {});
  // Two stretches of 100 frames have 99 steps each. Frames hold 32 bits: 1e-9 m, 1e-7 rad.
  EXPECT_NEAR(ValueIn(values, "path", "instrument"), 2 * 99 * 1e-4, 1e-6);
  EXPECT_NEAR(ValueIn(values, "depth_path", "instrument"), 99 * 1e-4, 1e-6);
  EXPECT_NEAR(ValueIn(values, "turn", "scope"), 2 * 99 * 0.01, 2e-5);
  // Roll alternates in sign, so the step to frame k is 0.01 (2 k - 1), and n steps are 0.01 n². In
  // the second stretch each step is 2 rad longer, since both rolls are 1 rad further.
  double second = 0;
  for (int k = 102; k <= 200; ++k) second += 0.01 * (2 * k - 1) + 2;
  EXPECT_NEAR(ValueIn(values, "roll_path", "scope"), 0.01 * 99 * 99 + second, 1e-4);
}

// Speed of a bell: d (1 - cos 2 π s) / T with the largest value 2 d / T in the middle.
double BellWay(double distance, double s) {
  return distance * (s - std::sin(2 * std::numbers::pi * s) / (2 * std::numbers::pi));
}

TEST(HandMetrics, MovesAreCountedPerMinuteOfMeasuredTime) {
  // Bells of 1 s that reach 30, 60 and 120 mm/s, with alternating directions.
  const double distances[] = {0.015, 0.015, 0.015, 0.030, 0.030, 0.060};
  auto frames = test::FramesOfTip(600, kHand, [&](int k) {
    double x = 0;
    for (int i = 0; i <= k / 100; ++i)
      x += (i % 2 == 0 ? 1 : -1) * BellWay(distances[i], i < k / 100 ? 1 : (k % 100 + 0.5) / 100);
    return glm::dvec3(x, 0, 0.02);
  });
  // Neither a pause nor a time outside of the joint is measured.
  std::vector<AttemptFrame> all(frames.begin(), frames.begin() + 300);
  test::Append(all, 200, PausedFrame());
  all.insert(all.end(), frames.begin() + 300, frames.begin() + 500);
  test::Append(all, 100, OutsideFrame());
  all.insert(all.end(), frames.begin() + 500, frames.end());
  const auto values = MeasureAttempt(all, {});
  EXPECT_NEAR(ValueIn(values, "moves_20", "instrument"), 60 * 6 / 6.0, 1e-9);
  EXPECT_NEAR(ValueIn(values, "moves_50", "instrument"), 60 * 3 / 6.0, 1e-9);
  EXPECT_NEAR(ValueIn(values, "moves_100", "instrument"), 60 * 1 / 6.0, 1e-9);
  EXPECT_EQ(ValueIn(values, "moves_20", "scope"), 0);
  EXPECT_NEAR(ValueIn(values, "measured_share", "instrument"), 6.0 / 7, 1e-12);
}

// Speed steps between 0 and 10 mm/s. A filter without a shift in time reaches the limit of 5 mm/s
// in the middle of each step, so the moving frames are counted exactly.
TEST(HandMetrics, IdleShareIsThatOfFramesInWhichNeitherToolMoves) {
  const auto ramp = [](int k, int begin, int end) {
    return 1e-4 * std::clamp(k + 0.5 - begin, 0.0, static_cast<double>(end - begin));
  };
  auto frames =
      test::FramesOfTip(1000, kHand, [&](int k) { return glm::dvec3(ramp(k, 200, 500), 0, 0.02); });
  for (std::size_t k = 0; k < frames.size(); ++k)
    frames[k].tool[Index(DeviceRole::kScope)].tip =
        glm::vec3(0, ramp(static_cast<int>(k), 400, 600), 0.02);
  // One of them moves in frames 200 to 599.
  EXPECT_NEAR(ValueIn(MeasureAttempt(frames, {}), "idle_share", "both"), 0.6, 1e-12);
  // Frames in which one tool is not in the joint do not count: 100 of 600 idle ones are left out.
  for (std::size_t k = 900; k < 1000; ++k) frames[k].tool[Index(kHand)].depth = -0.001F;
  EXPECT_NEAR(ValueIn(MeasureAttempt(frames, {}), "idle_share", "both"), 500.0 / 900, 1e-12);
}

// A tip on a circle goes along n chords of 2 R sin(ω h / 2) in n frames of contact.
TEST(HandMetrics, PathTimeAndImpulseInContactAreThoseOfEachSurface) {
  const double radius = 0.01, step = 0.01 * std::numbers::pi;  // rad per frame
  auto frames = test::FramesOfTip(800, kHand, [&](int k) {
    return glm::dvec3(radius * std::cos(step * k), radius * std::sin(step * k), 0.02);
  });
  const auto touch = [&](std::size_t begin, std::size_t end, int surface, float force) {
    for (std::size_t k = begin; k < end; ++k) {
      ToolFrame& tool = frames[k].tool[Index(kHand)];
      tool.contact = surface;
      tool.contact_share = 1;
      tool.mean_force = force;
    }
  };
  touch(0, 50, kBackdropContact, 0.5F);  // the first frame has none before it
  touch(100, 300, kBackdropContact, 0.5F);
  touch(500, 600, 1, 2.0F);
  const auto values = MeasureAttempt(frames, kTwoSurfaces);
  const double chord = 2 * radius * std::sin(0.5 * step);
  // The filter takes less than a hundredth of a step away.
  EXPECT_NEAR(ValueIn(values, "contact_path", "instrument on backdrop"), 249 * chord, 1e-2 * chord);
  EXPECT_NEAR(ValueIn(values, "contact_path", "instrument on meniscus"), 100 * chord, 1e-2 * chord);
  EXPECT_NEAR(ValueIn(values, "contact_time", "instrument on backdrop"), 2.5, 1e-9);
  EXPECT_NEAR(ValueIn(values, "contact_time", "instrument on meniscus"), 1, 1e-9);
  EXPECT_NEAR(ValueIn(values, "contact_impulse", "instrument on backdrop"), 1.25, 1e-9);
  EXPECT_NEAR(ValueIn(values, "contact_impulse", "instrument on meniscus"), 2, 1e-9);
  EXPECT_EQ(ValueIn(values, "contacts", "instrument on backdrop"), 2);
  EXPECT_EQ(ValueIn(values, "contacts", "instrument on meniscus"), 1);
  EXPECT_EQ(ValueIn(values, "contacts", "scope on meniscus"), 0);
  EXPECT_NEAR(ValueIn(values, "mean_force", "instrument"), (250 * 0.5 + 100 * 2.0) / 350, 1e-9);
}

// A contact ends after 30 frames without a touch, and a pause is no time.
TEST(HandMetrics, ThirtyFramesWithoutATouchPartTwoContacts) {
  const AttemptFrame touching = test::PressFrame(0, 1.0F), off = test::QuietFrame();
  std::vector<AttemptFrame> frames;
  test::Append(frames, 10, touching);
  test::Append(frames, 29, off);
  test::Append(frames, 10, touching);
  test::Append(frames, 30, off);
  test::Append(frames, 10, touching);
  test::Append(frames, 20, off);
  test::Append(frames, 50, PausedFrame());
  test::Append(frames, 9, off);
  test::Append(frames, 10, touching);
  const auto values = MeasureAttempt(frames, kTwoSurfaces);
  EXPECT_EQ(ValueIn(values, "contacts", "instrument on backdrop"), 2);
  EXPECT_NEAR(ValueIn(values, "contact_time", "instrument on backdrop"), 0.4, 1e-9);
}

// Triangles of 1 s with a peak of 17 N lie above 8.5 N for half of their time. The mean over the 99
// frames with a force is 17 · 50 / 99.
TEST(HandMetrics, ForceOfTrianglesOnTheScope) {
  std::vector<AttemptFrame> frames(300, test::QuietFrame());
  for (std::size_t k = 0; k < frames.size(); ++k) {
    ToolFrame& scope = frames[k].tool[Index(DeviceRole::kScope)];
    const double off = std::abs(static_cast<double>(k % 150) - 50);
    scope.mean_force = scope.peak_force = static_cast<float>(17 * std::max(0.0, 1 - off / 50));
    if (!(scope.mean_force > 0)) continue;
    scope.contact = kBackdropContact;
    scope.contact_share = 1;
  }
  const auto values = MeasureAttempt(frames, kTwoSurfaces, {.harm = 8.5});
  EXPECT_EQ(ValueIn(values, "peak_force", "scope"), 17);
  EXPECT_NEAR(ValueIn(values, "mean_force", "scope"), 17 * 50.0 / 99, 1e-5);
  EXPECT_NEAR(ValueIn(values, "over_time", "scope"), 2 * 0.5, 1e-6);
  EXPECT_EQ(ValueIn(values, "over_count", "scope"), 2);
  EXPECT_EQ(ValueIn(values, "peak_force", "instrument"), 0);
  EXPECT_EQ(ValueIn(values, "over_count", "instrument"), 0);
}

// Mean force: impulse per time in contact. Half of each frame is touched with 2 N, so frames have a
// mean of 1 N.
TEST(HandMetrics, MeanForceIsThatOfTheTimeInContact) {
  AttemptFrame half = test::PressFrame(0, 1.0F);
  half.tool[Index(kHand)].contact_share = 0.5F;
  const std::vector<AttemptFrame> frames(10, half);
  const auto values = MeasureAttempt(frames, kTwoSurfaces);
  EXPECT_NEAR(ValueIn(values, "mean_force", "instrument"), 2, 1e-9);
  EXPECT_NEAR(ValueIn(values, "contact_time", "instrument on backdrop"), 0.05, 1e-9);
  EXPECT_NEAR(ValueIn(values, "contact_impulse", "instrument on backdrop"), 0.1, 1e-9);
}

TEST(HandMetrics, NoFramesGiveNoMotionAndNoForce) {
  const auto values = MeasureAttempt({}, kTwoSurfaces);
  EXPECT_EQ(ValueIn(values, "task_time", "both"), 0);
  EXPECT_EQ(ValueIn(values, "contacts", "instrument on meniscus"), 0);
  for (const char* id :
       {"measured_share", "path", "depth_path", "turn", "roll_path", "moves_20", "moves_50",
        "moves_100", "sparc", "ldlj", "peak_force", "mean_force", "over_time", "over_count"})
    for (const char* part : {"scope", "instrument"})
      EXPECT_TRUE(test::IsMissingIn(values, id, part)) << id << " of " << part;
  EXPECT_TRUE(test::IsMissingIn(values, "idle_share", "both"));
  EXPECT_TRUE(test::IsMissingIn(values, "bimanual_r", "both"));
}

TEST(HandMetrics, OneFrameHasAForceAndNoMotion) {
  const std::vector<AttemptFrame> frames(1, test::PressFrame(0, 9.0F));
  const auto values = MeasureAttempt(frames, kTwoSurfaces);
  EXPECT_NEAR(ValueIn(values, "task_time", "both"), 0.01, 1e-12);
  EXPECT_EQ(ValueIn(values, "measured_share", "instrument"), 0);
  EXPECT_EQ(ValueIn(values, "peak_force", "instrument"), 9);
  EXPECT_EQ(ValueIn(values, "mean_force", "instrument"), 9);
  EXPECT_EQ(ValueIn(values, "over_count", "instrument"), 1);
  EXPECT_EQ(ValueIn(values, "over_time", "instrument"), 0) << "a line needs two frames";
  EXPECT_EQ(ValueIn(values, "contacts", "instrument on backdrop"), 1);
  EXPECT_NEAR(ValueIn(values, "contact_time", "instrument on backdrop"), 0.01, 1e-12);
  EXPECT_NEAR(ValueIn(values, "contact_impulse", "instrument on backdrop"), 0.09, 1e-12);
  EXPECT_EQ(ValueIn(values, "contact_path", "instrument on backdrop"), 0);
  EXPECT_TRUE(test::IsMissingIn(values, "path", "instrument"));
  EXPECT_TRUE(test::IsMissingIn(values, "idle_share", "both"));
}

// A hand that is not known has no numbers, so NaN in its frames reaches no metric.
TEST(HandMetrics, FramesOfAnUnknownHandAreNotRead) {
  auto frames = test::FramesOfTip(300, kHand, [](int k) { return glm::dvec3(1e-4 * k, 0, 0.02); });
  for (std::size_t k = 100; k < 200; ++k) {
    ToolFrame& tool = frames[k].tool[Index(kHand)];
    tool.tip = tool.drawn_tip = tool.axis = glm::vec3(NAN);
    tool.mean_force = tool.peak_force = tool.roll = tool.depth = NAN;
    tool.is_valid = false;
  }
  const auto values = MeasureAttempt(frames, kTwoSurfaces);
  for (const MetricValue& value : values)
    EXPECT_TRUE(std::isfinite(value.value.value_or(0))) << value.metric->id << " " << value.part;
  EXPECT_NEAR(ValueIn(values, "path", "instrument"), 2 * 99 * 1e-4, 1e-6);
  EXPECT_NEAR(ValueIn(values, "measured_share", "instrument"), 2.0 / 3, 1e-12);
  EXPECT_EQ(ValueIn(values, "peak_force", "instrument"), 0);
}

}  // namespace
}  // namespace arthro::simulation

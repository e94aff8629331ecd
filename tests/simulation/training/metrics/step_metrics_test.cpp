// Metrics that need the steps of an exercise, from frames that are made up, against closed forms.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/simulation/training/metrics/measured_value.h"

namespace arthro::simulation {
namespace {

using test::IsMissingIn;
using test::MeasuredAttempt;
using test::ValueIn;

constexpr double kPi = std::numbers::pi;

// A step that is done with an answer 0 and failed with an answer 1.
AnswerStep Question() {
  AnswerStep step;
  step.question = "Is it done?";
  step.choices = {{"Yes", ""}, {"No", ""}};
  return step;
}

// Acts of `count` frames, with one act in each of the frames that are named.
std::vector<std::vector<TraineeAct>> ActsIn(std::size_t count, const TraineeAct& act,
                                            std::initializer_list<std::size_t> frames) {
  std::vector<std::vector<TraineeAct>> acts(count);
  for (const std::size_t frame : frames) acts[frame].push_back(act);
  return acts;
}

// Half of a circle of radius r and a tangent of length L: legs 2 r + L on a path π r + L.
TEST(StepMetrics, PathEfficiencyOfAHalfCircleAndALine) {
  constexpr double kRadius = 0.01, kLine = 0.02;
  const Exercise exercise = test::ExerciseOf({Question(), Question()});
  const auto acts = ActsIn(401, {ActKind::kAnswer, 0, ""}, {200, 400});
  for (const DeviceRole role : kDeviceRoles) {
    const auto frames = test::FramesOfTip(401, role, [&](int k) {
      if (k > 200) return glm::dvec3(-kRadius, -kLine * (k - 200) / 200, 0.02);
      return glm::dvec3(kRadius * std::cos(kPi * k / 200), kRadius * std::sin(kPi * k / 200), 0.02);
    });
    const auto values = MeasuredAttempt(exercise, frames, acts);
    // The filter shortens the path where the curvature begins and ends, by less than 0.01 %.
    EXPECT_NEAR(ValueIn(values, "path_efficiency", ToString(role)),
                (2 * kRadius + kLine) / (kPi * kRadius + kLine), 1e-4)
        << ToString(role);
  }
}

TEST(StepMetrics, PathEfficiencyOfStraightWaysIsOne) {
  const auto frames = test::FramesOfTip(401, DeviceRole::kInstrument,
                                        [](int k) { return glm::dvec3(1e-4 * k, 0, 0.02); });
  const auto acts = ActsIn(401, {ActKind::kAnswer, 0, ""}, {150, 400});
  const auto values = MeasuredAttempt(test::ExerciseOf({Question(), Question()}), frames, acts);
  EXPECT_NEAR(ValueIn(values, "path_efficiency", "instrument"), 1, 1e-6);
}

// Filtering of a constant leaves a path of 1e-16 m, and speeds that differ by as much.
TEST(StepMetrics, AToolAtRestHasNoEfficiencyAndNoCorrelation) {
  const auto frames = test::FramesOfTip(401, DeviceRole::kInstrument,
                                        [](int) { return glm::dvec3(0.007, 0, 0.01); });
  const auto acts = ActsIn(401, {ActKind::kAnswer, 0, ""}, {150, 400});
  const auto values = MeasuredAttempt(test::ExerciseOf({Question(), Question()}), frames, acts);
  EXPECT_TRUE(IsMissingIn(values, "path_efficiency", "instrument"));
  EXPECT_TRUE(IsMissingIn(values, "path_efficiency", "scope"));
  EXPECT_TRUE(IsMissingIn(values, "bimanual_r", "both"));
}

TEST(StepMetrics, LookDownsAreThoseOfTheInstructor) {
  const std::vector<AttemptFrame> frames(100, test::QuietFrame());
  const auto acts = ActsIn(100, {ActKind::kLookDown, 0, ""}, {0, 40, 41});
  const Exercise exercise = test::ExerciseOf({Question()});
  EXPECT_EQ(ValueIn(MeasuredAttempt(exercise, frames, acts), "look_downs", "both"), 3);
  EXPECT_EQ(ValueIn(MeasuredAttempt(exercise, frames), "look_downs", "both"), 0);
}

ProbeStep ProbeOf(std::vector<std::string> targets) {
  ProbeStep step;
  step.targets = std::move(targets);
  return step;
}

// Two of three targets are pressed for 0.5 s each, the third for less.
TEST(StepMetrics, ProbedShareIsThatOfTheTargetsToPress) {
  std::vector<AttemptFrame> frames;
  test::Append(frames, 50, test::PressFrame(1, 1.0F, 3));
  test::Append(frames, 50, test::PressFrame(0, 1.0F, 3));
  test::Append(frames, 49, test::PressFrame(2, 1.0F, 3));
  test::Append(frames, 50, test::QuietFrame(3));
  const auto values =
      MeasuredAttempt(test::ExerciseOf({ProbeOf({"t0", "t1"}), ProbeOf({"t2"})}, 3), frames);
  EXPECT_NEAR(ValueIn(values, "probed_share", "instrument"), 2.0 / 3, 1e-12);
  EXPECT_TRUE(IsMissingIn(values, "seen_share", "scope"));
}

// The band is 0.5 to 3 N with both ends. Touches beside the target, and a tip at the target without
// a contact, do not count.
TEST(StepMetrics, BandShareCountsFramesInContactWithTheTarget) {
  const auto press = [](float force) { return test::PressFrame(0, force); };
  AttemptFrame beside = press(1.0F), off = press(1.0F);
  beside.tool[1].drawn_tip.y += 0.0021F;
  off.tool[1].contact = kNoContact;
  std::vector<AttemptFrame> frames;
  for (const auto& [count, frame] : {std::pair{20, press(0.4F)},
                                     {5, press(0.5F)},
                                     {20, press(1.0F)},
                                     {5, press(3.0F)},
                                     {10, press(3.1F)},
                                     {40, beside},
                                     {40, off}})
    test::Append(frames, count, frame);
  ProbeStep step = ProbeOf({"t0"});
  step.hold = 10;
  const auto values = MeasuredAttempt(test::ExerciseOf({step}), frames);
  EXPECT_NEAR(ValueIn(values, "band_share", "instrument"), 30.0 / 60, 1e-12);
  const std::vector<AttemptFrame> quiet(50, test::QuietFrame());
  EXPECT_TRUE(
      IsMissingIn(MeasuredAttempt(test::ExerciseOf({step}), quiet), "band_share", "instrument"));
}

// Distances from 5 to 30 mm are asked for. Frames without the target in the picture do not count.
TEST(StepMetrics, CentringAndDistanceErrorAreMeansWhileTheTargetIsClear) {
  HoldStep step;
  step.targets = {"t0"};
  const auto at = [](float centre, float distance) {
    AttemptFrame frame = test::QuietFrame();
    frame.sight.target[0].centre = centre;
    frame.sight.target[0].distance = distance;
    return frame;
  };
  std::vector<AttemptFrame> frames;
  test::Append(frames, 10, at(0.1F, 0.010F));
  test::Append(frames, 20, at(0.3F, 0.034F));  // 4 mm too far
  test::Append(frames, 30, at(0.5F, 0.003F));  // 2 mm too near
  test::Append(frames, 40, test::HiddenFrame());
  const auto values = MeasuredAttempt(test::ExerciseOf({step}), frames);
  EXPECT_NEAR(ValueIn(values, "centring", "scope"), (10 * 0.1 + 20 * 0.3 + 30 * 0.5) / 60, 1e-7);
  EXPECT_NEAR(ValueIn(values, "distance_error", "scope"), (20 * 0.004 + 30 * 0.002) / 60, 1e-8);
  const std::vector<AttemptFrame> hidden(50, test::HiddenFrame());
  const auto none = MeasuredAttempt(test::ExerciseOf({step}), hidden);
  EXPECT_TRUE(IsMissingIn(none, "centring", "scope"));
  EXPECT_TRUE(IsMissingIn(none, "distance_error", "scope"));
}

// A telescope step asks for no distance: it is about the way between two.
TEST(StepMetrics, ATelescopeStepHasCentringAndNoDistanceError) {
  TelescopeStep step;
  step.targets = {"t0"};
  const std::vector<AttemptFrame> frames(50, test::QuietFrame());
  const auto values = MeasuredAttempt(test::ExerciseOf({step}), frames);
  EXPECT_NEAR(ValueIn(values, "centring", "scope"), 0.1, 1e-7);
  EXPECT_TRUE(IsMissingIn(values, "distance_error", "scope"));
}

// A wrong answer leads back to a target that was seen, and pressed, before.
TEST(StepMetrics, ATargetOfAStepThatBeginsAgainCountsOnce) {
  SeeStep see;
  see.targets = {"t0"};
  ProbeStep probe = ProbeOf({"t0"});
  AnswerStep question = Question();
  question.choices[0].next = "s0";
  const Exercise exercise = test::ExerciseOf({see, probe, question});
  std::vector<AttemptFrame> frames(800, test::PressFrame(0, 1.0F));
  auto acts = ActsIn(800, {ActKind::kAnswer, 0, ""}, {390});
  acts[790].push_back({ActKind::kAnswer, 1, ""});
  const auto values = MeasuredAttempt(exercise, frames, acts);
  EXPECT_EQ(ValueIn(values, "seen_share", "scope"), 1);
  EXPECT_EQ(ValueIn(values, "probed_share", "instrument"), 1);
}

// The goal moves by 4 mm/s along 10 mm, that is for 250 frames. Root mean square of a whole period
// of A sin is A / √2.
TEST(StepMetrics, TrackErrorOfATipThatSwaysAcrossTheWay) {
  TrackStep step;
  step.path = {"t0", "t1"};
  step.by = StepBy::kTip;
  const auto frames = test::FramesOfTip(
      250, DeviceRole::kInstrument,
      [](int k) { return glm::dvec3(4e-5 * k, 0.003 * std::sin(2 * kPi * k / 250), 0.02); }, 2);
  const auto values = MeasuredAttempt(test::ExerciseOf({step}, 2), frames);
  EXPECT_NEAR(ValueIn(values, "track_error", "both"), 0.003 / std::numbers::sqrt2, 1e-7);
}

// A view axis that passes the goal 1.5 mm away, on every side, has this error. The view is turned
// by 30° from the rod, which lies along z, towards -y.
TEST(StepMetrics, TrackErrorOfAViewIsTheDistanceOfItsAxis) {
  TrackStep step;
  step.path = {"t0", "t1"};
  std::vector<AttemptFrame> frames(250, test::QuietFrame(2));
  const double angle = kPi / 6;
  const glm::dvec3 view(0, -std::sin(angle), std::cos(angle)), right(1, 0, 0),
      across(0, std::cos(angle), std::sin(angle));
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const double x = static_cast<double>(k), turn = 2 * kPi * x / 250;
    const glm::dvec3 goal(4e-5 * x, 0, 0.02);
    frames[k].lens =
        glm::vec3(goal - 0.01 * view + 0.0015 * (std::cos(turn) * right + std::sin(turn) * across));
  }
  const auto values = MeasuredAttempt(test::ExerciseOf({step}, 2), frames);
  EXPECT_NEAR(ValueIn(values, "track_error", "both"), 0.0015, 1e-7);
}

// The tip starts 0.05 mm after the begin of the path and goes 0.1 mm per frame. Frames after the
// first count. The ninth of ten pieces is reached after 80 of them, a whole period of A sin.
TEST(StepMetrics, LineErrorOfATipThatSwaysAcrossThePath) {
  FollowStep step;
  step.path = {"t0", "t1"};
  const auto frames = test::FramesOfTip(
      120, DeviceRole::kInstrument,
      [](int k) { return glm::dvec3(5e-5 + 1e-4 * k, 0.001 * std::sin(2 * kPi * k / 80), 0.02); },
      2);
  const auto values = MeasuredAttempt(test::ExerciseOf({step}, 2), frames);
  EXPECT_NEAR(ValueIn(values, "line_error", "both"), 0.001 / std::numbers::sqrt2, 1e-7);
}

// Targets are 10 mm apart. Marks are √(11² + 1.5²) mm apart in the first step, and 9 mm in the
// second.
TEST(StepMetrics, MeasureErrorIsTheMeanOfTheSteps) {
  MeasureStep step;
  step.targets = {"t0", "t1"};
  const auto touch = [](int target, float x, float y) {
    AttemptFrame frame = test::PressFrame(target, 1.0F, 2);
    frame.tool[1].drawn_tip.x += x;
    frame.tool[1].drawn_tip.y += y;
    return frame;
  };
  const std::vector<AttemptFrame> frames = {touch(0, -0.001F, 0), touch(1, 0, 0.0015F),
                                            touch(0, 0.0005F, 0), touch(1, -0.0005F, 0)};
  const auto acts = ActsIn(4, {ActKind::kMark, 0, ""}, {0, 1, 2, 3});
  const auto values = MeasuredAttempt(test::ExerciseOf({step, step}, 2), frames, acts);
  const double first = std::hypot(0.011, 0.0015) - 0.010, second = 0.001;
  EXPECT_NEAR(ValueIn(values, "measure_error", "instrument"), 0.5 * (first + second), 1e-8);
}

// Concentric arcs of 10 and 12 mm are 2 mm apart. The expert's way has 200 chords, whose middles
// lie 10 mm · (π / 200)² / 8 = 0.3 µm within the arc.
TEST(StepMetrics, GhostDistanceOfConcentricArcs) {
  Exercise exercise = test::ExerciseOf({Question(), Question()});
  exercise.ghost = "expert.attempt";
  const auto arc = [](double radius, double begin, double end, int count) {
    auto frames = test::FramesOfTip(count + 50, DeviceRole::kScope, [&](int k) {
      const double turn = begin + (end - begin) * k / count;
      if (k > count) return glm::dvec3(0, 0.05, 0.02);
      return glm::dvec3(radius * std::cos(turn), radius * std::sin(turn), 0.02);
    });
    // Neither a pause nor a time outside of the joint is part of a way.
    for (const std::size_t k : {60U, 61U, 62U}) {
      ToolFrame& scope = frames[k].tool[Index(DeviceRole::kScope)];
      scope.drawn_tip = glm::vec3(-0.05, 0, 0);
      frames[k].is_paused = k == 60;
      if (k > 60) scope.depth = -0.001F;
    }
    return frames;
  };
  const auto expert = arc(0.010, 0, kPi, 200), trainee = arc(0.012, 0.1 * kPi, 0.9 * kPi, 300);
  // The expert fails the second step, which the trainee does 50 mm away.
  auto answers = ActsIn(expert.size(), {ActKind::kAnswer, 0, ""}, {200});
  answers.back().push_back({ActKind::kAnswer, 1, ""});
  StepEngine engine(exercise);
  AdvanceAll(engine, expert, answers);
  ASSERT_EQ(engine.steps()[0].outcome, StepOutcome::kDone);
  ASSERT_EQ(engine.steps()[1].outcome, StepOutcome::kFailed);
  const GhostPath ghost{expert, engine.steps()};
  const auto acts = ActsIn(trainee.size(), {ActKind::kAnswer, 0, ""}, {300, trainee.size() - 1});
  const auto values = MeasuredAttempt(exercise, trainee, acts, &ghost);
  EXPECT_NEAR(ValueIn(values, "ghost_distance", "scope"), 0.002, 1e-6);
  EXPECT_TRUE(IsMissingIn(MeasuredAttempt(exercise, trainee, acts), "ghost_distance", "scope"));
}

// Pauses count neither as frames of a step nor as time. The tip is found 0.4 s after the start of
// the first step, and 1.2 s after that of the second.
TEST(StepMetrics, TriangulationIsTheMeanOfTheSteps) {
  AttemptFrame unseen = test::QuietFrame(2), paused = unseen;
  unseen.sight.is_tip_visible = false;
  paused.is_paused = true;
  std::vector<AttemptFrame> frames;
  test::Append(frames, 1, unseen);  // the first step starts in it
  test::Append(frames, 40, unseen);
  test::Append(frames, 50, test::QuietFrame(2));
  test::Append(frames, 70, paused);
  test::Append(frames, 50, test::PressFrame(0, 1.0F, 2));  // ends the step
  test::Append(frames, 120, unseen);
  test::Append(frames, 100, test::QuietFrame(2));
  const auto values =
      MeasuredAttempt(test::ExerciseOf({ProbeOf({"t0"}), ProbeOf({"t1"})}, 2), frames);
  EXPECT_NEAR(ValueIn(values, "triangulation", "instrument"), 0.5 * (0.4 + 1.2), 1e-9);
}

}  // namespace
}  // namespace arthro::simulation

// Each kind of step with frames made by hand: the done case, failures, gaps and restarts.
#include "simulation/training/steps/step_engine.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "simulation/core/random.h"
#include "tests/simulation/training/step_frames.h"

namespace arthro::simulation {
namespace {

using test::ExerciseOf;
using test::HiddenFrame;
using test::PressFrame;
using test::QuietFrame;
using test::Repeat;

int CountOf(const StepEngine& engine, EventKind kind) {
  return static_cast<int>(
      std::count_if(engine.events().begin(), engine.events().end(),
                    [&](const AttemptEvent& event) { return event.kind == kind; }));
}

template <class Step>
Step With(std::vector<std::string> targets) {
  Step step;
  step.targets = std::move(targets);
  return step;
}

TEST(StepEngine, SeesATargetAfterItsHold) {
  StepEngine engine(ExerciseOf({With<SeeStep>({"t0"})}));
  Repeat(engine, QuietFrame(), 99);
  EXPECT_EQ(engine.end(), AttemptEnd::kRunning);
  EXPECT_NEAR(engine.strip().progress, 0.99, 1e-12);
  Repeat(engine, QuietFrame(), 1);
  EXPECT_EQ(engine.end(), AttemptEnd::kCompleted);
  EXPECT_EQ(engine.steps()[0].outcome, StepOutcome::kDone);
  EXPECT_DOUBLE_EQ(*engine.steps()[0].ended, 1.0);
  ASSERT_EQ(CountOf(engine, EventKind::kSeen), 1);
  EXPECT_EQ(engine.events().back().kind, EventKind::kAttemptEnd);
}

TEST(StepEngine, ForgivesGapsOfATenthOfASecondAndNoMore) {
  StepEngine forgiven(ExerciseOf({With<SeeStep>({"t0"})}));
  Repeat(forgiven, QuietFrame(), 50);
  Repeat(forgiven, HiddenFrame(), 10);
  Repeat(forgiven, QuietFrame(), 40);
  EXPECT_EQ(forgiven.end(), AttemptEnd::kCompleted);
  StepEngine broken(ExerciseOf({With<SeeStep>({"t0"})}));
  Repeat(broken, QuietFrame(), 50);
  Repeat(broken, HiddenFrame(), 11);
  Repeat(broken, QuietFrame(), 99);
  EXPECT_EQ(broken.end(), AttemptEnd::kRunning);
  EXPECT_EQ(CountOf(broken, EventKind::kLost), 1);
  Repeat(broken, QuietFrame(), 1);
  EXPECT_EQ(broken.end(), AttemptEnd::kCompleted);
}

TEST(StepEngine, SeesOnlyWithinEachLimitOfSight) {
  const auto seen = [](const auto& change) {
    AttemptFrame frame = QuietFrame();
    change(frame);
    StepEngine engine(ExerciseOf({With<SeeStep>({"t0"})}));
    Repeat(engine, frame, 150);
    return engine.end() == AttemptEnd::kCompleted;
  };
  EXPECT_TRUE(seen([](AttemptFrame&) {}));
  EXPECT_FALSE(seen([](AttemptFrame& f) { f.sight.target[0].is_clear = false; }));
  EXPECT_FALSE(seen([](AttemptFrame& f) { f.sight.target[0].centre = 0.51F; }));
  EXPECT_FALSE(seen([](AttemptFrame& f) { f.sight.target[0].distance = 0.0049F; }));
  EXPECT_FALSE(seen([](AttemptFrame& f) { f.sight.target[0].distance = 0.0301F; }));
  EXPECT_FALSE(seen([](AttemptFrame& f) { f.sight.target[0].incidence = 1.06F; }));
  EXPECT_FALSE(seen([](AttemptFrame& f) { f.tool[0].depth = -0.001F; }));
}

TEST(StepEngine, HoldNeedsTheTargetInTheCentre) {
  AttemptFrame beside = QuietFrame();
  beside.sight.target[0].centre = 0.3F;
  StepEngine engine(ExerciseOf({With<HoldStep>({"t0"})}));
  Repeat(engine, beside, 600);
  EXPECT_EQ(engine.end(), AttemptEnd::kRunning);
  Repeat(engine, QuietFrame(), 500);
  EXPECT_EQ(engine.end(), AttemptEnd::kCompleted);
  EXPECT_NEAR(*engine.measures().centring.mean(), (600 * 0.3 + 500 * 0.1) / 1100, 1e-6);
}

AttemptFrame At(float distance, float centre = 0.1F) {
  AttemptFrame frame = QuietFrame();
  frame.sight.target[0].distance = distance;
  frame.sight.target[0].centre = centre;
  return frame;
}

TEST(StepEngine, TelescopeGoesFromFarToNearAndBack) {
  StepEngine engine(ExerciseOf({With<TelescopeStep>({"t0"})}));
  for (int cycle = 0; cycle < 2; ++cycle) {
    EXPECT_EQ(engine.end(), AttemptEnd::kRunning);
    Repeat(engine, At(0.021F), 10);
    Repeat(engine, At(0.0075F), 10);
  }
  Repeat(engine, At(0.019F), 10);
  EXPECT_EQ(engine.end(), AttemptEnd::kRunning);
  Repeat(engine, At(0.02F), 1);
  EXPECT_EQ(engine.end(), AttemptEnd::kCompleted);
}

TEST(StepEngine, TelescopeBeginsAnewOffTheCentre) {
  for (const int frames : {20, 21}) {
    StepEngine engine(ExerciseOf({With<TelescopeStep>({"t0"})}));
    Repeat(engine, At(0.021F), 30);
    Repeat(engine, At(0.0075F), 30);
    Repeat(engine, At(0.021F), 30);
    Repeat(engine, At(0.015F, 0.9F), frames);
    EXPECT_NEAR(engine.strip().progress, frames == 20 ? 0.5 : 0.0, 1e-12);
  }
}

TEST(StepEngine, PeriscopeSeesARingInOrderFromOnePlace) {
  PeriscopeStep ring = With<PeriscopeStep>({"t0", "t1"});
  const auto only = [](int target) {
    AttemptFrame frame = QuietFrame(2);
    frame.sight.target[static_cast<std::size_t>(1 - target)].is_clear = false;
    return frame;
  };
  StepEngine engine(ExerciseOf({ring}, 2));
  Repeat(engine, only(1), 100);  // out of order
  EXPECT_EQ(engine.strip().progress, 0);
  Repeat(engine, only(0), 50);
  AttemptFrame moved = only(1);
  moved.tool[0].drawn_tip.x += 0.0061F;
  Repeat(engine, moved, 1);  // begins anew
  EXPECT_EQ(engine.strip().progress, 0);
  Repeat(engine, only(0), 50);
  AttemptFrame other_angle = only(1);
  other_angle.view_angle = static_cast<float>(RadiansFromDegrees(70));
  Repeat(engine, other_angle, 100);
  EXPECT_EQ(engine.end(), AttemptEnd::kRunning);
  Repeat(engine, only(1), 50);
  EXPECT_EQ(engine.end(), AttemptEnd::kCompleted);
  EXPECT_EQ(engine.measures().seen, 2);
}

TEST(StepEngine, TracksAGoalThatMovesAlongItsPath) {
  TrackStep step;
  step.path = {"t0", "t1"};
  step.by = StepBy::kTip;
  StepEngine engine(ExerciseOf({step}, 2));
  AttemptFrame frame = PressFrame(0, 0, 2);
  frame.tool[1].drawn_tip.x = -0.006F;
  Repeat(engine, frame, 100);  // not caught yet: the goal waits
  EXPECT_EQ(engine.measures().track_error.count, 0);
  int frames = 0;
  while (engine.end() == AttemptEnd::kRunning && frames < 1000) {
    // 2 mm behind the goal, which is 0.04 mm further in each frame.
    frame.tool[1].drawn_tip.x = 4e-5F * static_cast<float>(frames++) - 0.002F;
    engine.Advance(frame);
  }
  EXPECT_EQ(frames, 250);  // 10 mm at 4 mm/s
  EXPECT_NEAR(*engine.measures().track_error.rms(), 0.002, 1e-8);
}

TEST(StepEngine, ProbesATargetInSightWithinTheForces) {
  const auto done = [](const auto& change) {
    AttemptFrame frame = PressFrame(0, 1.0F);
    change(frame);
    StepEngine engine(ExerciseOf({With<ProbeStep>({"t0"})}));
    Repeat(engine, frame, 50);
    return engine.end() == AttemptEnd::kCompleted && engine.measures().probed == 1;
  };
  EXPECT_TRUE(done([](AttemptFrame&) {}));
  EXPECT_FALSE(done([](AttemptFrame& f) { f.tool[1].mean_force = 0.4F; }));
  EXPECT_FALSE(done([](AttemptFrame& f) { f.tool[1].mean_force = 3.1F; }));
  EXPECT_FALSE(done([](AttemptFrame& f) { f.sight.is_tip_visible = false; }));
  EXPECT_FALSE(done([](AttemptFrame& f) { f.tool[1].drawn_tip.y += 0.0021F; }));
}

TEST(StepEngine, FollowsAPathInOrder) {
  FollowStep step;
  step.path = {"t0", "t1"};
  StepEngine engine(ExerciseOf({step}, 2));
  AttemptFrame frame = QuietFrame(2);
  const auto at = [&](double x, double off) {
    frame.tool[1].drawn_tip = glm::vec3(x, off, 0.02);
    engine.Advance(frame);
  };
  at(0.0095, 0);  // the end first does not count
  EXPECT_EQ(engine.strip().progress, 0);
  int frames = 0;
  while (engine.end() == AttemptEnd::kRunning && frames < 200) at(1e-4 * frames++, 0.001);
  EXPECT_EQ(engine.end(), AttemptEnd::kCompleted);
  EXPECT_LE(frames, 101);
  EXPECT_NEAR(*engine.measures().line_error.rms(), 0.001, 1e-4);
}

TEST(StepEngine, FollowBeginsAnewWhenTooMuchIsLeftOut) {
  FollowStep step;
  step.path = {"t0", "t1"};
  StepEngine engine(ExerciseOf({step}, 2));
  AttemptFrame frame = QuietFrame(2);
  for (const double x : {0.0005, 0.0045}) {
    frame.tool[1].drawn_tip = glm::vec3(x, 0, 0.02);
    Repeat(engine, frame, 3);
  }
  // Two of ten pieces are left out by the jump, and nine are needed.
  EXPECT_EQ(CountOf(engine, EventKind::kLost), 1);
  EXPECT_EQ(engine.end(), AttemptEnd::kRunning);
}

TEST(StepEngine, MeasuresBetweenTwoMarks) {
  StepEngine engine(ExerciseOf({With<MeasureStep>({"t0", "t1"})}, 2));
  const TraineeAct mark{ActKind::kMark, 0, ""};
  const AttemptFrame beside = QuietFrame(2);
  engine.Advance(beside, {&mark, 1});
  AttemptFrame first = PressFrame(0, 1.0F, 2);
  first.tool[1].drawn_tip.x += 0.0005F;
  engine.Advance(first, {&mark, 1});
  EXPECT_EQ(engine.end(), AttemptEnd::kRunning);
  engine.Advance(PressFrame(1, 1.0F, 2), {&mark, 1});
  EXPECT_EQ(engine.end(), AttemptEnd::kCompleted);
  EXPECT_NEAR(*engine.measures().measure_error.mean(), 0.0005, 1e-8);
  EXPECT_EQ(CountOf(engine, EventKind::kMark), 3);
}

TEST(StepEngine, TransfersABodyAndCountsDrops) {
  TransferStep step;
  step.bodies = {"t0"};
  step.to = "t1";
  Exercise exercise = ExerciseOf({step}, 2);
  exercise.targets[0].is_loose = true;
  StepEngine engine(exercise);
  AttemptFrame frame = QuietFrame(2);
  frame.instrument = ToolKind::kGrasper;
  const auto go = [&](float x, float opening, int frames) {
    frame.opening = opening;
    frame.sight.target[0].place.x = x;
    frame.tool[1].drawn_tip = frame.sight.target[0].place;
    Repeat(engine, frame, frames);
  };
  go(0, 1, 5);
  go(0, 0, 5);
  EXPECT_EQ(CountOf(engine, EventKind::kGrasp), 1);
  go(0.005F, 0, 5);
  go(0.005F, 1, 100);
  EXPECT_EQ(CountOf(engine, EventKind::kDrop), 1);
  go(0.005F, 0, 5);
  go(0.0095F, 0, 100);
  EXPECT_EQ(engine.end(), AttemptEnd::kRunning);  // still held
  go(0.0095F, 1, 60);
  EXPECT_EQ(engine.end(), AttemptEnd::kCompleted);
  EXPECT_EQ(CountOf(engine, EventKind::kPlaced), 1);
}

TEST(StepEngine, ResectionEndsOffTheTissue) {
  ResectStep step;
  step.regions = {"t0"};
  Exercise exercise = ExerciseOf({step});
  exercise.targets[0].ball.reset();
  exercise.targets[0].regions = {"flap"};
  StepEngine engine(exercise);
  AttemptFrame frame = PressFrame(0, 1.0F);
  frame.instrument = ToolKind::kPunch;
  frame.opening = 0;
  frame.taken = 4e-9F;
  frame.taken_outside = 1e-9F;
  frame.sight.target[0].taken_share = 0.95F;
  frame.sight.target[0].is_gone = true;
  Repeat(engine, frame, 2);
  frame.taken = frame.taken_outside = 0;
  Repeat(engine, frame, 50);
  EXPECT_EQ(engine.end(), AttemptEnd::kRunning);
  frame.tool[1].contact = kNoContact;
  frame.tool[1].drawn_tip.z += 0.006F;
  Repeat(engine, frame, 1);
  EXPECT_EQ(engine.end(), AttemptEnd::kCompleted);
  ASSERT_EQ(CountOf(engine, EventKind::kBite), 1);
  ASSERT_EQ(CountOf(engine, EventKind::kCutOutside), 1);
}

TEST(StepEngine, ABleedingRisesAndFallsOnceItsSourceIsPressed) {
  RecoverStep bleeding;
  bleeding.source = "t0";
  StepEngine engine(ExerciseOf({bleeding, With<SeeStep>({"t0"})}));
  Repeat(engine, QuietFrame(), 151);
  EXPECT_NEAR(engine.strip().haze, 0.4, 1e-9);  // half of 3 s
  Repeat(engine, PressFrame(0, 1.0F), 400);
  EXPECT_EQ(engine.steps()[0].outcome, StepOutcome::kDone);
  EXPECT_NEAR(engine.strip().haze, 0.8, 1e-9);
  AttemptFrame hidden = HiddenFrame();
  Repeat(engine, hidden, 300);
  EXPECT_NEAR(engine.strip().haze, 0.8 * std::exp(-1.0), 1e-9);
}

TEST(StepEngine, AnswersLeadWhereTheySay) {
  AnswerStep question;
  question.question = "Which is soft?";
  question.choices = {{"This", ""}, {"That", "s2"}};
  question.right = 0;
  for (const int answer : {0, 1, 7}) {
    StepEngine engine(ExerciseOf({question, With<SeeStep>({"t0"}), With<HoldStep>({"t0"})}));
    const TraineeAct act{ActKind::kAnswer, answer, ""};
    engine.Advance(QuietFrame(), {&act, 1});
    EXPECT_EQ(engine.steps()[0].outcome, answer == 0   ? StepOutcome::kDone
                                         : answer == 1 ? StepOutcome::kFailed
                                                       : StepOutcome::kRunning);
    EXPECT_EQ(engine.strip().step, answer == 0 ? 1 : answer == 1 ? 2 : 0);
  }
}

TEST(StepEngine, AStepFailsAtItsLimitAndLeadsToTheEndUnlessOptional) {
  for (const bool is_optional : {false, true}) {
    SeeStep step = With<SeeStep>({"t0"});
    step.limit = 0.5;
    step.is_optional = is_optional;
    StepEngine engine(ExerciseOf({step, With<SeeStep>({"t0"})}));
    Repeat(engine, HiddenFrame(), 49);
    EXPECT_EQ(engine.steps()[0].outcome, StepOutcome::kRunning);
    Repeat(engine, HiddenFrame(), 1);
    EXPECT_EQ(engine.steps()[0].outcome, StepOutcome::kFailed);
    EXPECT_EQ(engine.end(), is_optional ? AttemptEnd::kRunning : AttemptEnd::kStepFailed);
  }
}

TEST(StepEngine, FreeOrderTakesAnyStepFirst) {
  Exercise exercise = ExerciseOf({With<SeeStep>({"t0"}), With<SeeStep>({"t1"})}, 2);
  exercise.order = StepOrder::kFree;
  StepEngine engine(exercise);
  AttemptFrame second = QuietFrame(2);
  second.sight.target[0].is_clear = false;
  Repeat(engine, second, 100);
  EXPECT_EQ(engine.steps()[1].outcome, StepOutcome::kDone);
  EXPECT_EQ(engine.steps()[0].outcome, StepOutcome::kRunning);
  Repeat(engine, QuietFrame(2), 100);
  EXPECT_EQ(engine.end(), AttemptEnd::kCompleted);
}

TEST(StepEngine, PausesStopEveryClock) {
  SeeStep step = With<SeeStep>({"t0"});
  step.limit = 2;
  StepEngine engine(ExerciseOf({step}));
  Repeat(engine, QuietFrame(), 50);
  AttemptFrame paused = QuietFrame();
  paused.is_paused = true;
  Repeat(engine, paused, 1000);
  Repeat(engine, QuietFrame(), 50);
  EXPECT_EQ(engine.end(), AttemptEnd::kCompleted);
  EXPECT_DOUBLE_EQ(engine.duration(), 1.0);
  EXPECT_EQ(CountOf(engine, EventKind::kPause), 1);
  EXPECT_EQ(CountOf(engine, EventKind::kResume), 1);
}

TEST(StepEngine, LimitsEndTheAttempt) {
  Exercise timed = ExerciseOf({With<SeeStep>({"t0"})});
  timed.limits.time = 3;
  StepEngine slow(timed);
  Repeat(slow, HiddenFrame(), 299);
  EXPECT_EQ(slow.end(), AttemptEnd::kRunning);
  Repeat(slow, HiddenFrame(), 1);
  EXPECT_EQ(slow.end(), AttemptEnd::kLimit);
  Exercise gentle = ExerciseOf({With<SeeStep>({"t0"})});
  gentle.limits.force = 15;
  StepEngine rough(gentle);
  Repeat(rough, PressFrame(0, 14.9F), 2);
  EXPECT_EQ(rough.end(), AttemptEnd::kRunning);
  EXPECT_EQ(CountOf(rough, EventKind::kForceOver), 1);
  Repeat(rough, PressFrame(0, 15.1F), 1);
  EXPECT_EQ(rough.end(), AttemptEnd::kLimit);
  EXPECT_NE(rough.reason().find("15.1 N"), std::string::npos) << rough.reason();
}

TEST(StepEngine, CountsEntriesOfAZone) {
  Exercise exercise = ExerciseOf({With<SeeStep>({"t0"})});
  exercise.avoid = {{"t0", AvoidBy::kInstrument, 0.5}};
  StepEngine engine(exercise);
  for (const float force : {0.4F, 0.6F}) {
    Repeat(engine, HiddenFrame(), 20);
    AttemptFrame pressed = PressFrame(0, force);
    pressed.sight.target[0].is_clear = false;
    Repeat(engine, pressed, 5);
  }
  Repeat(engine, HiddenFrame(), 20);
  EXPECT_EQ(CountOf(engine, EventKind::kZoneIn), 1);
  EXPECT_EQ(CountOf(engine, EventKind::kZoneOut), 1);
}

TEST(StepEngine, ALostDeviceMakesTheAttemptVoid) {
  StepEngine engine(ExerciseOf({With<SeeStep>({"t0"})}));
  AttemptFrame lost = HiddenFrame();
  lost.tool[0].is_valid = false;
  Repeat(engine, lost, 100);
  EXPECT_EQ(engine.end(), AttemptEnd::kRunning);
  Repeat(engine, lost, 1);
  EXPECT_EQ(engine.end(), AttemptEnd::kVoid);
}

TEST(StepEngine, FailsAStepWhoseTargetWasCutAway) {
  StepEngine engine(ExerciseOf({With<SeeStep>({"t0"})}));
  AttemptFrame gone = QuietFrame();
  gone.sight.target[0].is_gone = true;
  engine.Advance(gone);
  EXPECT_EQ(engine.end(), AttemptEnd::kStepFailed);
}

TEST(StepEngine, GivesItsCueLateOrWhenAsked) {
  SeeStep step = With<SeeStep>({"t0"});
  step.cue = CueKind::kArrow;
  step.cue_after = 1;
  StepEngine engine(ExerciseOf({step}));
  Repeat(engine, HiddenFrame(), 99);
  EXPECT_FALSE(engine.strip().is_cue_due);
  Repeat(engine, HiddenFrame(), 1);
  EXPECT_TRUE(engine.strip().is_cue_due);
  StepEngine asked(ExerciseOf({step}));
  const TraineeAct hint{ActKind::kHint, 0, ""};
  asked.Advance(HiddenFrame(), {&hint, 1});
  EXPECT_TRUE(asked.strip().is_cue_due);
  EXPECT_EQ(CountOf(asked, EventKind::kCue), 1);
}

std::vector<int> OpenSteps(const StepEngine& engine) {
  std::vector<int> steps;
  for (const OpenStep& open : engine.strip().open) steps.push_back(open.step);
  return steps;
}

std::vector<int> CuedTargets(const StepEngine& engine) {
  std::vector<int> targets;
  for (const StripCue& cue : engine.strip().cues) targets.push_back(cue.target);
  return targets;
}

TEST(StepEngine, AHintIsAboutWhatEachKindOfStepNames) {
  const TraineeAct hint{ActKind::kHint, 0, ""};
  TransferStep transfer;
  transfer.bodies = {"t1", "t2"};
  transfer.to = "t0";
  ResectStep resect;
  resect.regions = {"t1"};
  RecoverStep recover;
  recover.source = "t2";
  PeriscopeStep ring;
  ring.targets = {"t2", "t0"};
  const std::pair<ExerciseStep, std::vector<int>> cases[] = {
      {transfer, {1, 2}}, {resect, {1}}, {recover, {2}}, {ring, {2}}};
  for (auto [step, wanted] : cases) {
    BaseOf(step).cue = CueKind::kOutline;
    BaseOf(step).cue_after = 60;
    StepEngine engine(ExerciseOf({step}, 3));
    engine.Advance(HiddenFrame(3));
    EXPECT_TRUE(engine.strip().cues.empty()) << KindOf(step);
    engine.Advance(HiddenFrame(3), {&hint, 1});
    EXPECT_EQ(CuedTargets(engine), wanted) << KindOf(step);
    EXPECT_EQ(engine.strip().cues.front().kind, CueKind::kOutline);
  }
}

TEST(StepEngine, AHintToABodyInTheGrasperIsItsGoal) {
  TransferStep step;
  step.bodies = {"t1", "t2"};
  step.to = "t0";
  step.cue = CueKind::kOutline;
  StepEngine engine(ExerciseOf({step}, 3));
  AttemptFrame frame = PressFrame(2, 0, 3);
  frame.instrument = ToolKind::kGrasper;
  engine.Advance(frame);
  EXPECT_EQ(CuedTargets(engine), (std::vector<int>{1, 2}));
  frame.opening = 0;
  engine.Advance(frame);
  EXPECT_EQ(CuedTargets(engine), (std::vector<int>{0}));
}

TEST(StepEngine, AFreeOrderHasEveryStepOpenThatIsNotDone) {
  Exercise exercise = ExerciseOf({With<SeeStep>({"t0"}), With<SeeStep>({"t1"})}, 2);
  exercise.order = StepOrder::kFree;
  for (ExerciseStep& step : exercise.steps) BaseOf(step).cue = CueKind::kName;
  StepEngine engine(exercise);
  AttemptFrame frame = QuietFrame(2);
  frame.sight.target[1].is_clear = false;
  engine.Advance(frame);
  EXPECT_EQ(OpenSteps(engine), (std::vector<int>{0, 1}));
  EXPECT_EQ(CuedTargets(engine), (std::vector<int>{0, 1}));
  Repeat(engine, frame, 100);
  EXPECT_EQ(OpenSteps(engine), (std::vector<int>{1}));
  EXPECT_EQ(CuedTargets(engine), (std::vector<int>{1}));
}

// Frames that wander between all states of sight and touch.
TEST(StepEngine, AnyPiecesOfARecordingGiveTheSameEvents) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    Random random(seed);
    FollowStep follow;
    follow.path = {"t0", "t1"};
    Exercise exercise = ExerciseOf(
        {With<ProbeStep>({"t0", "t1"}), follow, With<SeeStep>({"t0"}), With<HoldStep>({"t1"})}, 2);
    exercise.order = seed % 2 == 0 ? StepOrder::kFree : StepOrder::kFixed;
    exercise.avoid = {{"t1", AvoidBy::kBoth, 0}};
    std::vector<AttemptFrame> frames;
    while (frames.size() < 3000) {
      AttemptFrame frame = random.Below(3) == 0
                               ? HiddenFrame(2)
                               : PressFrame(static_cast<int>(random.Below(2)),
                                            static_cast<float>(random.Uniform(0, 10)), 2);
      frame.is_paused = random.Below(8) == 0;
      frames.insert(frames.end(), 1 + random.Below(120), frame);
    }
    StepEngine whole(exercise), pieces(exercise);
    AdvanceAll(whole, frames);
    const std::span<const AttemptFrame> all(frames);
    for (std::size_t at = 0; at < all.size();) {
      const std::size_t count = std::min<std::size_t>(1 + random.Below(400), all.size() - at);
      AdvanceAll(pieces, all.subspan(at, count));
      at += count;
    }
    whole.Finish();
    pieces.Finish();
    EXPECT_EQ(whole.events(), pieces.events()) << seed;
    EXPECT_GT(whole.events().size(), 4u);
  }
}

}  // namespace
}  // namespace arthro::simulation

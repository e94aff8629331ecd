// Metrics against closed forms, from hands that are sampled at 100, 250 and 1,000 Hz.
#include "simulation/training/metrics/metrics.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "simulation/core/units.h"
#include "simulation/training/metrics/exercise_metrics.h"
#include "simulation/training/metrics/hand_path.h"
#include "simulation/training/metrics/metric_words.h"
#include "simulation/training/metrics/smoothness.h"
#include "tests/simulation/training/simulated_attempt.h"
#include "tests/simulation/training/step_frames.h"

namespace arthro::simulation {
namespace {

using test::FramesOf;
using test::ToolAt;

const double kRates[] = {100, 250, 1000};

std::optional<double> ValueOf(const std::vector<AttemptFrame>& frames, std::string_view id,
                              std::string_view part, const MetricLimits& limits = {}) {
  for (const MetricValue& value : MeasureAttempt(frames, {"backdrop"}, limits))
    if (value.metric->id == id && value.part == part) return value.value;
  ADD_FAILURE() << "no metric " << id << " of " << part;
  return std::nullopt;
}

Snapshot Instrument(const ToolState& state) {
  Snapshot snapshot;
  snapshot.instrument = state;
  return snapshot;
}

// Radius 10 mm, pitch 5 mm, 4 turns in 8 s, about an axis in the joint.
glm::dvec3 Helix(double t) {
  const double turn = kRadianPerTurn * t / 2;
  return {0.01 * std::cos(turn), 0.01 * std::sin(turn), 0.02 + 0.005 * t / 2};
}

// Length of one turn: 2 π times the root of the squares of radius and rise per radian.
const double kHelixTurn = kRadianPerTurn * std::hypot(0.01, 0.005 / kRadianPerTurn);

TEST(Metrics, PathOfAHelix) {
  // A frame stands for its middle, so 7.99 s of the way lie between the first and the last.
  const double exact = 4 * kHelixTurn * 7.99 / 8;
  EXPECT_NEAR(exact, 0.251807, 1e-6);
  for (const double rate : kRates) {
    const auto frames = FramesOf(8, rate, [](double t) { return Instrument(ToolAt(Helix(t))); });
    EXPECT_NEAR(*ValueOf(frames, "path", "instrument"), exact, 2e-4 * exact) << rate;
  }
}

TEST(Metrics, NoiseOfTheDeviceHardlyLengthensThePath) {
  const double exact = 4 * kHelixTurn * 7.99 / 8;
  for (const double rate : kRates) {
    std::mt19937_64 random(5);
    std::normal_distribution<double> noise(0, 5e-5);
    const auto frames = FramesOf(8, rate, [&](double t) {
      return Instrument(ToolAt(Helix(t) + glm::dvec3(noise(random), noise(random), noise(random))));
    });
    // Half a percent is asked of a noise of 0.05 mm.
    EXPECT_NEAR(*ValueOf(frames, "path", "instrument"), exact, 5e-3 * exact) << rate;
  }
}

TEST(Metrics, TurnOnACone) {
  const double slope = RadiansFromDegrees(20);
  const double exact = 2 * kRadianPerTurn * std::sin(slope) * 7.99 / 8;
  EXPECT_NEAR(DegreesFromRadians(exact), 245.947, 1e-3);
  for (const double rate : kRates) {
    const auto frames = FramesOf(8, rate, [&](double t) {
      const double turn = kRadianPerTurn * t / 4;
      return Instrument(
          ToolAt(0.02 * glm::dvec3(std::sin(slope) * std::cos(turn),
                                   std::sin(slope) * std::sin(turn), std::cos(slope))));
    });
    EXPECT_NEAR(*ValueOf(frames, "turn", "instrument"), exact, 1e-4 * exact) << rate;
    // The tip stays as deep as it is: its way along the rod is a small part of its way.
    EXPECT_LT(*ValueOf(frames, "depth_path", "instrument"),
              2e-3 * *ValueOf(frames, "path", "instrument"));
  }
}

TEST(Metrics, RollAndDepthAddUp) {
  const auto frames = FramesOf(4, 1000, [](double t) {
    ToolState state = ToolAt({0, 0, 0.02 + 0.005 * std::sin(kRadianPerTurn * t / 2)});
    state.pose.roll = 0.5 * std::sin(kRadianPerTurn * t / 4);
    return Instrument(state);
  });
  // Two whole swings of 5 mm, and one of 0.5 rad.
  EXPECT_NEAR(*ValueOf(frames, "depth_path", "instrument"), 2 * 4 * 0.005, 2e-4);
  EXPECT_NEAR(*ValueOf(frames, "roll_path", "instrument"), 4 * 0.5, 1e-2);
}

// Minimum jerk: speed 30 d / T (s² − 2 s³ + s⁴) at the share s of the time T.
double MinimumJerk(double distance, double duration, double t) {
  const double s = std::clamp(t / duration, 0.0, 1.0);
  return distance * s * s * s * (10 - 15 * s + 6 * s * s);
}

std::vector<double> SpeedOfMoves(int moves, double duration, double rate) {
  const auto frames = FramesOf(moves * duration, rate, [&](double t) {
    double x = 0;
    for (int i = 0; i < moves; ++i) x += MinimumJerk(0.02, duration, t - i * duration);
    return Instrument(ToolAt({x, 0, 0.02}));
  });
  const auto paths = HandPathsOf(frames, DeviceRole::kInstrument);
  EXPECT_EQ(paths.size(), 1U);
  return paths.at(0).speed;
}

TEST(Metrics, SmoothnessOfMinimumJerk) {
  // Closed form of the jerk: T³ / v² ∫ v''² dt = 720 / (15/8)² = 204.8.
  const double exact = -std::log(204.8);
  for (const double rate : kRates)
    for (const double duration : {1.0, 2.0, 4.0}) {
      const auto speed = SpeedOfMoves(1, duration, rate);
      EXPECT_NEAR(*SpectralArcLength(speed), -1.4059, 1e-4) << rate << " " << duration;
      EXPECT_NEAR(*LogDimensionlessJerk(speed), exact, 0.06) << rate << " " << duration;
      // The largest speed is 15/8 of the mean; one of 9.4 mm/s does not stand out by 10.
      EXPECT_EQ(MoveCount(speed, 0.005), duration > 3 ? 0 : 1);
    }
}

TEST(Metrics, SeveralMovesAreLessSmooth) {
  for (const double rate : kRates) {
    const auto two = SpeedOfMoves(2, 1, rate), five = SpeedOfMoves(5, 1, rate);
    EXPECT_NEAR(*SpectralArcLength(two), -2.2440, 1e-3) << rate;
    EXPECT_NEAR(*SpectralArcLength(five), -3.3007, 1e-3) << rate;
    // n moves of one second: the duration is n times as long, the integral n times as large.
    EXPECT_NEAR(*LogDimensionlessJerk(two), -std::log(204.8 * 16), 0.06) << rate;
    EXPECT_NEAR(*LogDimensionlessJerk(five), -std::log(204.8 * 625), 0.06) << rate;
    EXPECT_EQ(MoveCount(two, 0.02), 2);
    EXPECT_EQ(MoveCount(five, 0.02), 5);
    EXPECT_EQ(MoveCount(five, 0.05), 0) << "the largest speed is 37.5 mm/s";
  }
}

TEST(Metrics, SmoothnessIsThatOfTheShapeAlone) {
  const auto speed = SpeedOfMoves(2, 1, 1000);
  std::vector<double> faster = speed;
  for (double& v : faster) v *= 7;
  EXPECT_NEAR(*SpectralArcLength(faster), *SpectralArcLength(speed), 1e-12);
  EXPECT_NEAR(*LogDimensionlessJerk(faster), *LogDimensionlessJerk(speed), 1e-12);
}

TEST(Metrics, BothHands) {
  for (const double rate : kRates) {
    // Ways sin and cos have the speeds |cos| and |sin|.
    const auto frames = FramesOf(20, rate, [](double t) {
      Snapshot snapshot;
      snapshot.scope = ToolAt({0.01 * std::sin(kRadianPerTurn * t / 2), 0, 0.02});
      snapshot.instrument = ToolAt({0.01 * std::cos(kRadianPerTurn * t / 2), 0, 0.02});
      return snapshot;
    });
    // Closed form: (1/π − 4/π²) / (1/2 − 4/π²).
    EXPECT_NEAR(*ValueOf(frames, "bimanual_r", "both"), -0.9183, 3e-4) << rate;
    EXPECT_EQ(*ValueOf(frames, "idle_share", "both"), 0);
  }
}

TEST(Metrics, ForceOfHalfASine) {
  for (const double rate : kRates) {
    const auto frames = FramesOf(2, rate, [](double t) {
      ToolState state = ToolAt({0, 0, 0.02});
      if (t > 0.5 && t <= 1) {
        state.contact = kBackdropContact;
        state.tip_force = {0, 0, 6 * std::sin(kRadianPerTurn * (t - 0.5))};
      }
      return Instrument(state);
    });
    const auto value = [&](const char* id, const char* part = "instrument") {
      return *ValueOf(frames, id, part, {.harm = 5});
    };
    // A sum over n ticks of half a sine is smaller than the integral by x cot x, x = π / 2n.
    const double x = std::numbers::pi / rate;
    const double mean = 12 / std::numbers::pi * x / std::tan(x);
    EXPECT_NEAR(value("mean_force"), mean, 1e-3) << rate;
    EXPECT_NEAR(value("contact_impulse", "instrument on backdrop"), 0.5 * mean, 1e-3) << rate;
    EXPECT_NEAR(value("contact_time", "instrument on backdrop"), 0.5, 1e-6);
    EXPECT_EQ(value("contacts", "instrument on backdrop"), 1);
    EXPECT_NEAR(value("peak_force"), 6, 6e-3);
    EXPECT_NEAR(value("over_time"), 0.5 * (1 - 2 / std::numbers::pi * std::asin(5.0 / 6)), 5e-4);
    EXPECT_EQ(value("over_count"), 1);
  }
}

TEST(Metrics, ContactEndsAfterThreeTenthsOfASecond) {
  const auto frames = FramesOf(4, 1000, [](double t) {
    ToolState state = ToolAt({0, 0, 0.02});
    const bool is_touching = t < 1 || (t > 1.2 && t < 1.5) || t > 2;
    state.contact = is_touching ? kBackdropContact : kNoContact;
    return Instrument(state);
  });
  EXPECT_EQ(*ValueOf(frames, "contacts", "instrument on backdrop"), 2);
}

TEST(Metrics, PauseCountsNothing) {
  FrameBuilder builder(0.0);
  for (int i = 1; i <= 3000; ++i) {
    const double t = 0.001 * i;
    ToolState state = ToolAt({0.01 * t, 0, 0.02});
    state.tip_force = {0, 0, t > 1 && t <= 2 ? 20.0 : 1.0};
    builder.Add(t, Instrument(state), t > 1 && t <= 2);
  }
  builder.Finish();
  EXPECT_NEAR(*ValueOf(builder.frames(), "task_time", "both"), 2, 1e-9);
  EXPECT_NEAR(*ValueOf(builder.frames(), "path", "instrument"), 0.02 * 0.99, 1e-6);
  EXPECT_EQ(*ValueOf(builder.frames(), "peak_force", "instrument"), 1);
  EXPECT_EQ(*ValueOf(builder.frames(), "over_time", "instrument"), 0);
}

TEST(Metrics, ValueThatIsMissingSaysWhy) {
  std::set<std::string_view> given;
  const std::vector<AttemptFrame> none, still(1, AttemptFrame{});
  for (const auto* frames : {&none, &still})
    for (const MetricValue& value :
         MeasureExercise(*frames, StepEngine(Exercise()), {"backdrop"})) {
      given.insert(value.metric->id);
      EXPECT_EQ(value.value.has_value(), value.why_none.empty()) << value.metric->id;
      const auto parts = PartsOf(value.metric->id);
      EXPECT_TRUE(std::ranges::count(parts, value.part) == 1 ||
                  (parts.empty() && value.part.ends_with(" on backdrop")))
          << value.metric->id << ": " << value.part;
      EXPECT_TRUE(std::isfinite(value.value.value_or(0))) << value.metric->id;
    }
  EXPECT_EQ(given.size(), EveryMetric().size());
  EXPECT_FALSE(ValueOf(still, "path", "scope").has_value());
  EXPECT_FALSE(ValueOf(still, "sparc", "instrument").has_value());
}

// Rounding of a resting tool is no movement.
TEST(Metrics, SmoothnessOfAToolThatRestsIsNotMeasured) {
  const auto frames = FramesOf(8, 1000, [](double t) {
    const double tremor = 2e-6 * std::sin(kRadianPerTurn * 8 * t);  // m; 0.1 mm/s
    return Instrument(ToolAt({0.01 + tremor, 0, 0.02}));
  });
  EXPECT_FALSE(ValueOf(frames, "sparc", "instrument").has_value());
  EXPECT_FALSE(ValueOf(frames, "ldlj", "instrument").has_value());
  EXPECT_TRUE(ValueOf(frames, "path", "instrument").has_value());
}

double ExerciseValue(const std::vector<AttemptFrame>& frames, std::string_view id,
                     const std::vector<ExerciseStep>& steps = {}, int targets = 1) {
  StepEngine engine(test::ExerciseOf(steps, targets));
  AdvanceAll(engine, frames);
  for (const MetricValue& value : MeasureExercise(frames, engine, {"backdrop"}))
    if (value.metric->id == id && value.value) return *value.value;
  return NAN;
}

// 2 s of sight, 0.5 s without, 1 s of sight, 0.51 s without.
TEST(ExerciseMetrics, ToolLossCountsFramesAndLongEpisodes) {
  std::vector<AttemptFrame> frames(401, test::QuietFrame());
  for (std::size_t k = 0; k < frames.size(); ++k)
    frames[k].sight.is_tip_visible = !((k >= 200 && k < 250) || k >= 350);
  EXPECT_NEAR(ExerciseValue(frames, "tool_loss"), 101.0 / 401, 1e-12);
  EXPECT_EQ(ExerciseValue(frames, "loss_episodes"), 1);
}

TEST(ExerciseMetrics, TriangulationEndsWhereASecondOfSightBegins) {
  ProbeStep step;
  step.targets = {"t0"};
  std::vector<AttemptFrame> frames(500, test::QuietFrame());
  for (std::size_t k = 0; k < frames.size(); ++k)
    frames[k].sight.is_tip_visible = (k >= 50 && k < 149) || k >= 231;
  // The step starts in the first frame, at 0.01 s.
  EXPECT_NEAR(ExerciseValue(frames, "triangulation", {step}), 2.30, 1e-9);
}

TEST(ExerciseMetrics, HorizonIsTheMeanTurnEitherWay) {
  std::vector<AttemptFrame> frames(100, test::QuietFrame());
  for (std::size_t k = 0; k < frames.size(); ++k)
    frames[k].head_roll = k % 2 == 0 ? 0.25F : static_cast<float>(kRadianPerTurn) - 0.75F;
  EXPECT_NEAR(ExerciseValue(frames, "horizon"), 0.5, 1e-6);
}

// 1 − exp(−100 h r) passes 0.55 at h r = 0.007985 m.
TEST(ExerciseMetrics, DisturbedShareFollowsTheExtinctionOfHaze) {
  std::vector<AttemptFrame> frames(100, test::QuietFrame());
  for (std::size_t k = 0; k < frames.size(); ++k) frames[k].haze = k < 30 ? 0.80F : 0.79F;
  EXPECT_NEAR(ExerciseValue(frames, "disturbed_share"), 0.3, 1e-12);
}

TEST(ExerciseMetrics, NearLensCountsTheTimeWithinTwoMillimetres) {
  std::vector<AttemptFrame> frames(100, test::QuietFrame());
  for (std::size_t k = 40; k < frames.size(); ++k) frames[k].tool[1].drawn_tip.x = 0.0021F;
  EXPECT_NEAR(ExerciseValue(frames, "lens_near"), 0.4, 1e-12);
}

TEST(ExerciseMetrics, SharesOfTargetsCountEachOnce) {
  SeeStep one, two;
  one.targets = {"t0"};
  two.targets = {"t1"};
  const std::vector<AttemptFrame> frames(150, test::QuietFrame(2));
  EXPECT_NEAR(ExerciseValue(frames, "seen_share", {one, two}, 2), 0.5, 1e-12);
  EXPECT_TRUE(std::isnan(ExerciseValue(frames, "probed_share", {one, two}, 2)));
}

// The expert's tip goes along x for the step; the trainee's goes the same way 2 mm beside it.
TEST(ExerciseMetrics, GhostDistanceIsTheMeanDistanceFromTheExpertsWayInTheSameStep) {
  ProbeStep step;
  step.targets = {"t0"};
  Exercise exercise = test::ExerciseOf({step});
  exercise.ghost = "expert.attempt";
  const auto way = [](float beside) {
    std::vector<AttemptFrame> frames(400, test::QuietFrame());
    for (std::size_t k = 0; k < 300; ++k)
      frames[k].tool[1].drawn_tip = {1e-4F * static_cast<float>(k), beside, 0.01F};
    // Then the target is pressed, which ends the step.
    std::fill(frames.begin() + 300, frames.end(), test::PressFrame(0, 1));
    return frames;
  };
  const auto expert = way(0), trainee = way(0.002F);
  StepEngine own(exercise), ghost(exercise);
  AdvanceAll(own, trainee);
  AdvanceAll(ghost, expert);
  ASSERT_EQ(ghost.steps()[0].outcome, StepOutcome::kDone);
  const GhostPath path{expert, ghost.steps()};
  // Frames 1 to 299 are 2 mm beside, 50 press where the expert pressed.
  EXPECT_NEAR(*GhostDistance(trainee, own.steps(), path, DeviceRole::kInstrument),
              0.002 * 299 / 349, 2e-5);
  EXPECT_FALSE(GhostDistance({}, own.steps(), path, DeviceRole::kInstrument).has_value());
  bool is_given = false;
  for (const MetricValue& value : MeasureExercise(trainee, own, {"backdrop"}, {}, &path))
    if (value.metric->id == "ghost_distance") is_given = value.value.has_value();
  EXPECT_TRUE(is_given);
}

TEST(Metrics, SameFramesGiveTheSameBits) {
  const auto frames = FramesOf(8, 250, [](double t) { return Instrument(ToolAt(Helix(t))); });
  const auto first = MeasureAttempt(frames, {"backdrop"}),
             again = MeasureAttempt(frames, {"backdrop"});
  ASSERT_EQ(first.size(), again.size());
  for (std::size_t i = 0; i < first.size(); ++i) EXPECT_EQ(first[i].value, again[i].value);
}

}  // namespace
}  // namespace arthro::simulation

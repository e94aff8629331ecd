// Criteria, z-values, learning curve, CUSUM and gates.
#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "simulation/scene/scene.h"
#include "simulation/training/metrics/exercise_metrics.h"
#include "simulation/training/score/criteria.h"
#include "simulation/training/score/learning.h"
#include "tests/simulation/training/step_frames.h"

namespace arthro::simulation {
namespace {

const Metric& MetricOf(std::string_view id) {
  return *std::find_if(EveryMetric().begin(), EveryMetric().end(),
                       [&](const Metric& metric) { return metric.id == id; });
}

TEST(Criteria, AValueThatWasNotMeasuredIsNotMet) {
  const std::vector<Criterion> criteria = {{"task_time", "", {}, 120, {}, "own"},
                                           {"seen_share", "", 0.9, {}, {}, ""},
                                           {"peak_force", "instrument", {}, 8.5, {}, ""},
                                           {"peak_force", "", {}, 8.5, {}, ""}};
  const std::vector<MetricValue> values = {{&MetricOf("task_time"), "both", 120.0, ""},
                                           {&MetricOf("seen_share"), "scope", std::nullopt, "none"},
                                           {&MetricOf("peak_force"), "scope", 9.0, ""},
                                           {&MetricOf("peak_force"), "instrument", 3.0, ""}};
  const auto results = JudgeCriteria(criteria, values);
  EXPECT_TRUE(results[0].is_met);
  EXPECT_FALSE(results[1].is_met);
  EXPECT_TRUE(results[2].is_met);
  EXPECT_FALSE(results[3].is_met) << "two parts, and the criterion names none";
}

TEST(Criteria, AGroupSetsTheLimitFromFiveMembersOn) {
  const std::vector<Criterion> criteria = {
      {"task_time", "", {}, 120, GroupLimit{"experts", 2}, "own start value"}};
  const std::vector<MetricValue> values = {{&MetricOf("task_time"), "both", 100.0, ""}};
  for (const int n : {4, 5}) {
    const std::vector<GroupValues> groups = {{"experts", "task_time", "both", n, 60, 10}};
    const CriterionResult result = JudgeCriteria(criteria, values, groups)[0];
    EXPECT_EQ(result.is_start_value, n == 4);
    EXPECT_EQ(*result.high, n == 4 ? 120 : 80);
    EXPECT_EQ(result.is_met, n == 4);
  }
}

TEST(Criteria, ZValuesArePositiveForTheBetter) {
  // Logarithms of times 1, 2, 3, 4, 5 away from each other by equal steps: mean 3, sd √2.5.
  std::vector<double> times;
  for (int i = 1; i <= 5; ++i) times.push_back(std::exp(i));
  EXPECT_NEAR(*ZValue(MetricOf("task_time"), std::exp(1.0), times), 2 / std::sqrt(2.5), 1e-12);
  const std::array<double, 5> shares = {1, 2, 3, 4, 5};
  EXPECT_NEAR(*ZValue(MetricOf("seen_share"), 1, shares), -2 / std::sqrt(2.5), 1e-12);
  EXPECT_FALSE(ZValue(MetricOf("seen_share"), 1, std::span(shares).first(4)));
  EXPECT_FALSE(ZValue(MetricOf("task_time"), 0, times));
  const double next = std::nextafter(0.1, 1);
  EXPECT_FALSE(ZValue(MetricOf("seen_share"), 1, std::vector{0.1, 0.1, next, 0.1, next}))
      << "members that differ by rounding alone";
}

TEST(Criteria, PassNeedsStepsAndCriteria) {
  SeeStep see;
  see.targets = {"t0"};
  Exercise exercise = test::ExerciseOf({see});
  exercise.criteria = {{"task_time", "", {}, 1.5, {}, ""}};
  for (const int hidden : {0, 60}) {
    StepEngine engine(exercise);
    std::vector<AttemptFrame> frames(static_cast<std::size_t>(hidden), test::HiddenFrame());
    frames.insert(frames.end(), 100, test::QuietFrame());
    AdvanceAll(engine, frames);
    const AttemptResult result = ResultOf(engine, MeasureExercise(frames, engine, {"backdrop"}));
    EXPECT_EQ(result.outcome, hidden == 0 ? AttemptOutcome::kPassed : AttemptOutcome::kFailed);
    EXPECT_EQ(result.reason, hidden == 0 ? "" : "Time: 1.6 s, asked for at most 1.5 s.");
  }
}

TEST(Criteria, TheCheckNamesAnUnknownMetric) {
  Scene scene;
  scene.exercises.push_back(test::ExerciseOf({}));
  scene.exercises[0].criteria = {{"task_time", "", {}, 1, {}, ""}, {"elegance", "", {}, 1, {}, ""}};
  const std::vector<std::string> faults = CriterionFaults(scene);
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_NE(faults[0].find("exercises[0].criteria[1].metric is \"elegance\""), std::string::npos);
}

TEST(Learning, MedianOfTheLastThree) {
  const std::vector<std::optional<double>> values = {9.0, 5.0, std::nullopt, 1.0, 7.0};
  EXPECT_EQ(RunningMedian(values), (std::vector<std::optional<double>>{9.0, 7.0, 7.0, 5.0, 5.0}));
}

// Numbers of the rule: p0 .10, p1 .30, α = β = .10.
TEST(Learning, CusumHasTheStepsAndLinesOfItsRule) {
  EXPECT_NEAR(CusumOfPass(), -0.186, 5e-4);
  EXPECT_NEAR(CusumOfFail(), 0.814, 5e-4);
  EXPECT_NEAR(CusumUpperLine(), 1.628, 5e-4);
  EXPECT_NEAR(CusumLowerLine(), -1.628, 5e-4);
  const std::array<bool, 9> passes = {true, true, true, true, true, true, true, true, true};
  const auto sums = Cusum(passes);
  EXPECT_GT(sums[7], CusumLowerLine());
  EXPECT_LE(sums[8], CusumLowerLine()) << "nine passes from 0 to the line";
}

TEST(Learning, AGateSaysWhyItIsShut) {
  const ExerciseGate gate{2, 3};
  std::vector<GateAttempt> attempts = {{"h", false, true}, {"old", true, true}, {"h", true, true}};
  GateState state = GateOf(gate, "h", attempts);
  EXPECT_EQ(state.consecutive, 1) << "practice and other versions do not count";
  EXPECT_EQ(state.reason,
            "Pass the test 1 more time in a row. 1 pass at an earlier version of the exercise "
            "does not count.");
  attempts.push_back({"h", true, false});
  EXPECT_EQ(GateOf(gate, "h", attempts).consecutive, 0);
  for (int i = 0; i < 4; ++i) attempts.push_back({"h", true, true});
  state = GateOf(gate, "h", attempts);
  EXPECT_FALSE(state.is_open);
  EXPECT_EQ(state.in_total, 2);
  attempts.push_back({"h", true, false});
  attempts.push_back({"h", true, true});
  state = GateOf(gate, "h", attempts);
  EXPECT_TRUE(state.is_open);
  EXPECT_EQ(state.reason, "");
}

}  // namespace
}  // namespace arthro::simulation

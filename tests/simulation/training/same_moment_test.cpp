// Moments of two attempts that belong together.
#include "simulation/training/steps/same_moment.h"

#include <vector>

#include <gtest/gtest.h>

namespace arthro::simulation {
namespace {

StepResult Done(const char* id, double began, double ended) {
  return {id, StepOutcome::kDone, began, ended};
}

TEST(SameMoment, IsAtTheSameShareOfTheSameStep) {
  const std::vector<StepResult> own = {Done("a", 0, 10), Done("b", 10, 40)};
  const std::vector<StepResult> expert = {Done("a", 0, 4), Done("b", 4, 10)};
  EXPECT_DOUBLE_EQ(SameMoment(own, expert, 0), 0);
  EXPECT_DOUBLE_EQ(SameMoment(own, expert, 5), 2);
  EXPECT_DOUBLE_EQ(SameMoment(own, expert, 10), 4);
  EXPECT_DOUBLE_EQ(SameMoment(own, expert, 25), 7);
  EXPECT_DOUBLE_EQ(SameMoment(own, expert, 99), 10) << "after the last step";
}

TEST(SameMoment, FollowsTheStepsInTheOrderInWhichTheyWereDone) {
  // A tour in free order: all steps begin at once.
  const std::vector<StepResult> own = {Done("a", 0, 30), Done("b", 0, 10), Done("c", 0, 20)};
  const std::vector<StepResult> expert = {Done("a", 0, 2), Done("b", 0, 4), Done("c", 0, 6)};
  EXPECT_DOUBLE_EQ(SameMoment(own, expert, 5), 3) << "half of b";
  EXPECT_DOUBLE_EQ(SameMoment(own, expert, 15), 5) << "half of c";
  EXPECT_DOUBLE_EQ(SameMoment(own, expert, 25), 1) << "half of a, which the expert did first";
}

TEST(SameMoment, OfStepsThatEndInOneFrameBeginsWhereTheStepBeforeEnded) {
  const std::vector<StepResult> own = {Done("a", 0, 10), Done("b", 0, 30), Done("c", 0, 30)};
  for (const std::size_t step : {1U, 2U}) {
    const StepTime time = TimeOf(own, own[step]);
    EXPECT_DOUBLE_EQ(time.begin, 10);
    EXPECT_DOUBLE_EQ(time.end, 30);
  }
}

TEST(SameMoment, OfAStepThatWasNotDoneFollowsTheClock) {
  std::vector<StepResult> own = {Done("a", 0, 10), {"b", StepOutcome::kFailed, 10, 60.0}};
  const std::vector<StepResult> expert = {Done("a", 0, 4), Done("b", 4, 10)};
  EXPECT_DOUBLE_EQ(SameMoment(own, expert, 13), 7);
  EXPECT_DOUBLE_EQ(SameMoment(own, expert, 50), 10);
  own[1] = {"b", StepOutcome::kRunning, 10, std::nullopt};
  EXPECT_DOUBLE_EQ(SameMoment(own, expert, 13), 7);
}

TEST(SameMoment, WithoutStepsIsTheTime) { EXPECT_DOUBLE_EQ(SameMoment({}, {}, 3), 3); }

}  // namespace
}  // namespace arthro::simulation

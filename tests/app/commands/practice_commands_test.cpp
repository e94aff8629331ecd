// Commands of practice and film, without a window.
#include <gtest/gtest.h>

#include "app/steps/panorama/panorama_step.h"
#include "app/steps/practice/film.h"
#include "app/steps/practice/hand_motion.h"
#include "app/steps/practice/practice_step.h"
#include "app/steps/tissue/tissue_step.h"
#include "simulation/core/units.h"
#include "simulation/scene/json/scene_json.h"
#include "tests/app/commands/command_test.h"

namespace arthro::app {
namespace {

TEST(Film, APictureBecomesNumberedPictures) {
  EXPECT_EQ(NumberedPictures("a/practice.png"), "a/practice-%04d.png");
  EXPECT_EQ(NumberedPictures("a/frame-%03d.png"), "a/frame-%03d.png");
  EXPECT_EQ(NumberedPictures("a/practice.mp4"), "a/practice.mp4");
}

TEST_F(Commands, PracticeLeavesTheEditorExactlyAsItWas) {
  Open();
  SetIncisionSpacing(state, 0.02);
  state.step = Step::kTissue;
  state.scope.latitude = 0.1;
  const std::string before = Print(state);
  const auto scope = state.scope;
  const int position = state.history.Position();

  app::Run(state, "practise");
  Settle(state);
  ASSERT_TRUE(state.practice);
  EXPECT_NEAR(state.practice->incision_spacing(), 0.02, 1e-15);
  MoveHands(state, {0.2, 0.1, 0.3, 0.004}, {0.0, 0.1, 0.0, 0.01});
  state.practice->Advance(0.05);
  app::Run(state, "view-90");
  app::Run(state, "undo");
  app::Run(state, "leave-practice");

  EXPECT_FALSE(state.practice);
  EXPECT_EQ(Print(state), before);
  EXPECT_EQ(state.history.Position(), position);
  EXPECT_EQ(state.step, Step::kTissue);
  EXPECT_EQ(state.scope.latitude, scope.latitude);
  EXPECT_EQ(state.scope.depth, scope.depth);
}

// One touch of Escape ended a session of seven minutes with everything that it had measured.
TEST_F(Commands, ALongPracticeIsLeftByTheSecondTouchOnly) {
  Open();
  app::Run(state, "practise");
  Settle(state);
  ASSERT_TRUE(state.practice);
  const auto practise = [this](double seconds) {
    const double end = state.practice->snapshot().t + seconds;
    while (state.practice->snapshot().t < end) state.practice->Advance(0.05);
  };
  practise(61);
  app::Run(state, "leave-practice");
  ASSERT_TRUE(state.practice) << "it asks first";
  EXPECT_NE(state.message.find("It took 1:01 min"), std::string::npos) << state.message;
  EXPECT_NE(state.message.find("Leave once more to end the session."), std::string::npos);
  practise(11);
  app::Run(state, "leave-practice");
  ASSERT_TRUE(state.practice) << "the first touch was long ago";
  practise(2);
  app::Run(state, "leave-practice");
  EXPECT_FALSE(state.practice);
  EXPECT_NE(state.message.find("Practice left."), std::string::npos) << state.message;
}

TEST_F(Commands, ASceneWithoutAPanoramaCannotBePractised) {
  app::Run(state, "practise");
  Settle(state);
  EXPECT_FALSE(state.practice);
}

TEST_F(Commands, InPracticeTheInstrumentPressesOnTheJointAndTheForceIsShown) {
  Open();
  app::Run(state, "practise");
  Settle(state);
  ASSERT_TRUE(state.practice);
  // Straight in until it must have met the backdrop, 40 to 50 mm away.
  state.practice->instrument().Set({0.0, -0.5, 0.0, 0.047});
  for (int i = 0; i < 30; ++i) state.practice->Advance(0.016);
  const auto& instrument = state.practice->snapshot().instrument;
  EXPECT_NE(instrument.contact, simulation::kNoContact);
  EXPECT_GT(glm::length(instrument.tip_force), 0.05);
  EXPECT_GE(state.practice->peak_force(), glm::length(instrument.tip_force));
}

TEST_F(Commands, TheCameraHeadIsHeldOrTurnsWithTheScopeAndEveryPracticeBeginsWithItStraight) {
  Open();
  app::Run(state, "head-upright");
  EXPECT_FALSE(state.steps.practice->head.is_upright) << "only in practice";
  app::Run(state, "practise");
  Settle(state);
  ASSERT_TRUE(state.practice);
  EXPECT_EQ(state.steps.practice->head, simulation::CameraHead{})
      << "with the scope, as in the paper";
  app::Run(state, "head-upright");
  for (int i = 0; i < 3; ++i) app::Run(state, "head-right");
  app::Run(state, "head-left");
  EXPECT_TRUE(state.steps.practice->head.is_upright);
  EXPECT_NEAR(state.steps.practice->head.turn, 2 * kHeadStep, 1e-15);
  for (int i = 0; i < 91; ++i) app::Run(state, "head-right");
  EXPECT_NEAR(state.steps.practice->head.turn, RadiansFromDegrees(2 * 93 - 360), 1e-7)
      << "round and on";
  app::Run(state, "reset-hands");
  EXPECT_EQ(state.steps.practice->head, simulation::CameraHead{.is_upright = true});
  TurnHead(state, 0.4);
  app::Run(state, "head-with-scope");
  EXPECT_EQ(state.steps.practice->head, simulation::CameraHead{}) << "and straight again";
  TurnHead(state, 0.4);
  app::Run(state, "leave-practice");
  EXPECT_FALSE(TurnHead(state, 0.1));
  app::Run(state, "practise");
  Settle(state);
  EXPECT_EQ(state.steps.practice->head.turn, 0.0);
}

TEST_F(Commands, ALongPauseIsNotMadeUpFor) {
  Open();
  app::Run(state, "practise");
  Settle(state);
  const double before = state.practice->snapshot().t;
  state.practice->Advance(10.0);
  EXPECT_NEAR(state.practice->snapshot().t - before, simulation::Practice::kLongestPause, 1.5e-3);
}

}  // namespace
}  // namespace arthro::app

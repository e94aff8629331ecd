// Reach of scope and instrument on the Portals page, without a window.

#include <gtest/gtest.h>

#include "app/editor/every_step.h"
#include "app/files/scene_files.h"
#include "app/state/edits.h"
#include "app/steps/portals/portals_step.h"
#include "simulation/core/units.h"
#include "tests/app/commands/settle.h"
#include "tests/support/small_scene.h"
#include "tests/support/temp_folder.h"

namespace arthro::app {
namespace {

class Reach : public testing::Test {
 protected:
  void SetUp() override {
    OpenScene(state, test::WriteSmallScene(temp / "knee"));
    Settle();
    ASSERT_TRUE(state.dialogs.empty());
    state.step = Step::kPortals;
  }
  void Settle() { app::Settle(state); }
  ReachBoard& board() { return state.steps.portals->reach; }

  test::TempFolder temp;
  EditorState state = MakeEditorState(NewDocument());
};

TEST_F(Reach, IsComputedOnlyWhileItIsShown) {
  Settle();
  EXPECT_EQ(board().made, nullptr);
  EXPECT_EQ(ReachPictureOf(state), nullptr);
  board().is_shown = true;
  FinishWork(state);
  Settle();
  ASSERT_NE(board().made, nullptr);
  const auto picture = ReachPictureOf(state);
  ASSERT_NE(picture, nullptr);
  EXPECT_EQ(picture->width, state.document().panorama->width);
  FinishWork(state);
  EXPECT_FALSE(board().jobs.busy()) << "nothing changed";
  state.step = Step::kTissue;
  EXPECT_EQ(ReachPictureOf(state), nullptr) << "another page";
}

TEST_F(Reach, FollowsTheIncisionSpacingAndKeepsThePartOfTheScope) {
  board().is_shown = true;
  FinishWork(state);
  Settle();
  const auto before = board().made;
  SetIncisionSpacing(state, -0.02);
  EndDrag(state);
  FinishWork(state);
  Settle();
  EXPECT_NE(board().made, before);
  EXPECT_EQ(board().made->key.incision_spacing, -0.02);
  EXPECT_EQ(board().made->scope, before->scope);
  SetViewAngle(state, RadiansFromDegrees(70));
  FinishWork(state);
  Settle();
  EXPECT_NE(board().made->scope, before->scope);
}

TEST_F(Reach, SuggestedSpacingIsOneStepThatCanBeUndone) {
  const double before = state.document().scene.portals.incision_spacing;
  SuggestSpacing(state, 0);
  Settle();
  const double spacing = state.document().scene.portals.incision_spacing;
  EXPECT_NE(spacing, before);
  EXPECT_NE(state.message.find("octahedron"), std::string::npos) << state.message;
  state.history.Undo();
  EXPECT_EQ(state.document().scene.portals.incision_spacing, before);
}

TEST_F(Reach, AngleBetweenTheRodsIsThatOfTheirDirections) {
  state.scope = {0, 0, 0, 0.02};
  state.instrument = {0, -0.5, 0, 0.02};
  EXPECT_NEAR(AngleBetweenRods(state), 0.5, 1e-12);
}

}  // namespace
}  // namespace arthro::app

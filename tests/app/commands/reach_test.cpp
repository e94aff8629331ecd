// Reach of scope and instrument on the Portals page, without a window.

#include <cmath>
#include <vector>

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
  SuggestSpacing(state);
  Settle();
  const double spacing = state.document().scene.portals.incision_spacing;
  EXPECT_NE(spacing, before);
  EXPECT_NE(state.message.find("octahedron"), std::string::npos) << state.message;
  state.history.Undo();
  EXPECT_EQ(state.document().scene.portals.incision_spacing, before);
}

TEST_F(Reach, TargetsAreChosenAmongReliefTissuesAndThoseOfExercises) {
  Edit(state, "Exercise", "", [](authoring::Document& next) {
    Exercise& exercise = next.scene.exercises.emplace_back();
    exercise.id = "tour";
    for (const double longitude : {-0.3, 0.4}) {
      ExerciseTarget& target = exercise.targets.emplace_back();
      target.id = longitude < 0 ? "left" : "right";
      target.bearing = glm::dvec2(0, longitude);
    }
  });
  const auto every = EverySpacingTarget(state.document().scene);
  ASSERT_EQ(every.size(), 4u);
  EXPECT_EQ(ChosenSpacingTargets(state), std::vector{every[1]}) << "the tissue, of old";
  ToggleSpacingTarget(state, every[3]);
  ToggleSpacingTarget(state, every[1]);
  ToggleSpacingTarget(state, every[3]);
  EXPECT_EQ(ChosenSpacingTargets(state), std::vector{every[3]}) << "the last one stays";
  ToggleSpacingTarget(state, every[0]);
  const PlacedTargets placed = PlaceTargets(state.document(), ChosenSpacingTargets(state));
  EXPECT_TRUE(placed.targets.has_relief);
  ASSERT_EQ(placed.points.size(), 1u);
  EXPECT_NEAR(std::atan2(placed.points[0].x, placed.points[0].z), 0.4, 1e-3);
  SuggestSpacing(state);
  Settle();
  EXPECT_TRUE(state.dialogs.empty());
  EXPECT_NE(state.message.find("tour: right, relief"), std::string::npos) << state.message;
  // Targets that are gone are chosen no more.
  Edit(state, "No exercise", "", [](authoring::Document& next) { next.scene.exercises.clear(); });
  EXPECT_EQ(ChosenSpacingTargets(state), std::vector{every[0]});
}

TEST_F(Reach, AShaftThroughTheReliefIsNamedAndHasAPlace) {
  EXPECT_TRUE(FindShaftConflicts(state).empty());
  state.instrument = {0, 0, 0, 0.08};  // beyond the backdrop of 50 mm
  const auto findings = FindShaftConflicts(state);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_NE(findings[0].words.find("instrument enters bone"), std::string::npos)
      << findings[0].words;
  EXPECT_GT(findings[0].x_in_portal.z, 0.02);
  EXPECT_EQ(findings[0].x_in_portal.x, state.document().scene.portals.incision_spacing);
  // Another relief is another obstacle.
  Edit(state, "Larger", "", [](authoring::Document& next) { next.scene.backdrop.radius = 0.2; });
  EXPECT_TRUE(FindShaftConflicts(state).empty());
}

TEST_F(Reach, AngleBetweenTheRodsIsThatOfTheirDirections) {
  state.scope = {0, 0, 0, 0.02};
  state.instrument = {0, -0.5, 0, 0.02};
  EXPECT_NEAR(AngleBetweenRods(state), 0.5, 1e-12);
}

}  // namespace
}  // namespace arthro::app

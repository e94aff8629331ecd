// Solids of the author, without a window.
#include "app/steps/solids/solid_edit.h"

#include <algorithm>
#include <memory>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "app/editor/every_step.h"
#include "app/state/command.h"
#include "app/state/edits.h"
#include "app/steps/tissue/cut/tissue_cut.h"
#include "app/steps/tissue/tissue_step.h"
#include "authoring/project/document_io.h"
#include "simulation/practice/cut_skin.h"
#include "simulation/scene/files/scene_io.h"
#include "simulation/scene/solids/solid_io.h"
#include "tests/support/plain_document.h"
#include "tests/support/temp_folder.h"

namespace arthro::app {
namespace {

class SolidEdit : public testing::Test {
 protected:
  SolidEdit() { state.reset(new EditorState(MakeEditorState(test::PlainDocument()))); }
  void Do(const char* command) { app::Run(*state, command); }
  const std::vector<Tissue>& Tissues() const { return state->document().scene.tissues; }
  std::vector<SolidPart> Parts() { return ChosenSolid(*state)->parts; }
  std::unique_ptr<EditorState> state;
};

TEST_F(SolidEdit, ANewSolidLiesOnTheReliefByOneStep) {
  Do("add-solid");
  ASSERT_EQ(Tissues().size(), 1u);
  EXPECT_TRUE(Tissues()[0].is_implicit);
  EXPECT_TRUE(IsSolidChosen(*state));
  EXPECT_EQ(Parts().size(), 1u);
  EXPECT_GT(glm::length(Tissues()[0].pose.position), 0.03) << "on the relief, not before it";
  Do("undo");
  EXPECT_TRUE(Tissues().empty());
  EXPECT_FALSE(state->history.CanUndo());
  Do("redo");
  EXPECT_EQ(Parts().size(), 1u);
}

TEST_F(SolidEdit, TheHandleOfAPartMovesTurnsAndSizesItAsOneStep) {
  Do("add-solid");
  Do("add-capsule");
  const std::size_t step = state->history.Position();
  const PartInPortal part = ChosenPart(*state);
  ASSERT_TRUE(part.surface);
  const auto before = std::get<CapsulePart>(Parts()[1]);
  Pose to = part.pose;
  to.position += 0.001 * glm::normalize(to.position);
  to.scale *= 1.5;
  PlacePart(*state, part.pose, false);
  PlacePart(*state, to, false);
  PlacePart(*state, to, true);
  const auto after = std::get<CapsulePart>(Parts()[1]);
  EXPECT_NEAR(after.radius, 1.5 * before.radius, 1e-12);
  EXPECT_NEAR(glm::distance(after.place.solid_from_part.translation,
                            before.place.solid_from_part.translation),
              0.001, 1e-9);
  EXPECT_EQ(state->history.Position(), step + 1) << "one step";
  const PartInPortal now = ChosenPart(*state);
  EXPECT_LT(glm::distance(now.pose.position, to.position), 1e-12);
  EXPECT_FALSE(state->steps.tissue->solids->is_coarse);
  Do("undo");
  EXPECT_EQ(std::get<CapsulePart>(Parts()[1]), before);
  state->steps.tissue->page = TissuePage::kPlace;
  EXPECT_FALSE(ChosenPart(*state).surface) << "only on its page";
}

TEST_F(SolidEdit, EveryPartIsAddedMovedAndRemovedByOneStepEach) {
  Do("add-solid");
  for (const char* command :
       {"add-ellipsoid", "add-capsule", "add-torus", "add-box", "add-plane"}) {
    const auto before = state->document().surfaces[0];
    Do(command);
    EXPECT_NE(state->document().surfaces[0], before) << command << ": " << state->message;
  }
  const std::vector<SolidPart> all = Parts();
  ASSERT_EQ(all.size(), 6u);
  EXPECT_STREQ(TypeOf(all[5]), "plane");
  EXPECT_EQ(state->steps.tissue->solids->part, 5);
  Do("part-up");
  EXPECT_STREQ(TypeOf(Parts()[4]), "plane");
  Do("undo");
  EXPECT_EQ(Parts(), all);
  state->steps.tissue->solids->part = 2;
  Do("remove-part");
  EXPECT_EQ(Parts().size(), 5u);
  Do("undo");
  EXPECT_EQ(Parts(), all);
  for (int step = 0; step < 5; ++step) Do("undo");
  EXPECT_EQ(Parts().size(), 1u);
}

TEST_F(SolidEdit, ADragIsOneStepAndEndsFine) {
  Do("add-solid");
  const std::size_t coarse_limit = state->document().surfaces[0]->triangles.size();
  EllipsoidPart ball = std::get<EllipsoidPart>(Parts()[0]);
  state->dragging = true;
  for (int i = 0; i < 5; ++i) {
    ball.radii.x += 1e-4;
    SetSolidPart(*state, ball, "Resize");
  }
  EXPECT_LT(state->document().surfaces[0]->triangles.size(), coarse_limit / 2);
  state->dragging = false;
  SetSolidPart(*state, ball, "Resize");
  EXPECT_GT(state->document().surfaces[0]->triangles.size(), coarse_limit / 2);
  Do("undo");
  EXPECT_EQ(std::get<EllipsoidPart>(Parts()[0]).radii.x, 3e-3);
  EXPECT_EQ(state->history.Position(), 1);
}

TEST_F(SolidEdit, AChangeThatLeavesNoFitSolidIsNotMade) {
  Do("add-solid");
  const Solid before = *ChosenSolid(*state);
  EllipsoidPart same = std::get<EllipsoidPart>(before.parts[0]);
  same.place.join = SolidJoin::kDifference;
  AddSolidPart(*state, same);
  EXPECT_EQ(*ChosenSolid(*state), before);
  EXPECT_NE(state->message.find("nothing is left"), std::string::npos) << state->message;
  EXPECT_EQ(state->history.Position(), 1);
}

TEST_F(SolidEdit, ItsFunctionIsSavedAndComesBack) {
  Do("add-solid");
  Do("add-torus");
  const Solid solid = *ChosenSolid(*state);
  const test::TempFolder folder;
  const authoring::Document saved =
      authoring::SaveDocument(state->document(), folder.path() / "scene");
  const LoadedScene loaded = LoadScene(folder.path() / "scene");
  ASSERT_TRUE(IsSolidFile(loaded.scene.tissues.at(0).surface));
  EXPECT_EQ(ReadSolid(FileOf(loaded, loaded.scene.tissues[0].surface)), solid);
  EXPECT_EQ(loaded.surfaces[0]->vertices.size(), saved.surfaces[0]->vertices.size());
}

TEST_F(SolidEdit, TheCutPageTakesItWithoutTetrahedra) {
  Do("add-solid");
  state->steps.tissue->cut_brush.kind = CutBrush::Kind::kBite;
  UseCutBrush(*state, 0, {0, 0, 6e-3});  // on top of the ball
  ASSERT_EQ(Tissues()[0].cuts.size(), 1u) << state->message;
  const simulation::BodySkin skin =
      simulation::CutSkin(Tissues()[0], *state->document().surfaces[0]);
  EXPECT_GT(std::count(skin.is_fresh.begin(), skin.is_fresh.end(), 1), 0);
  Do("undo");
  EXPECT_TRUE(Tissues()[0].cuts.empty());
}

TEST_F(SolidEdit, ADuplicateIsChangedOnItsOwn) {
  Do("add-solid");
  Do("duplicate-tissue");
  Do("add-box");
  EXPECT_EQ(Parts().size(), 2u);
  state->tissue = 0;
  EXPECT_EQ(Parts().size(), 1u);
}

}  // namespace
}  // namespace arthro::app

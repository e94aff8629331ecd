// Commands of the document: edit, undo, save, open again and quit.
#include <fstream>

#include <gtest/gtest.h>

#include "app/steps/depth/depth_step.h"
#include "app/steps/panorama/panorama_step.h"
#include "app/steps/portals/portals_step.h"
#include "app/steps/practice/rig_edit.h"
#include "app/steps/tissue/tissue_step.h"
#include "simulation/core/units.h"
#include "simulation/scene/json/scene_json.h"
#include "tests/app/commands/command_test.h"
#include "tests/support/build_paths.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;

TEST_F(Commands, OpenEditUndoRedoSaveAndOpenAgainGivesTheSameScene) {
  Open();
  EXPECT_TRUE(state.history.IsSaved());
  const std::string opened = Print(state);

  SetIncisionSpacing(state, MetresFromMm(-20));
  EndDrag(state);
  SetViewAngle(state, RadiansFromDegrees(70));
  const std::string edited = Print(state);
  EXPECT_FALSE(state.history.IsSaved());

  app::Run(state, "undo");
  app::Run(state, "undo");
  EXPECT_EQ(Print(state), opened);
  EXPECT_TRUE(state.history.IsSaved()) << "all edits were taken back";
  app::Run(state, "redo");
  app::Run(state, "redo");
  EXPECT_EQ(Print(state), edited);

  app::Run(state, "save");
  Settle(state);
  EXPECT_TRUE(state.history.IsSaved());
  const Scene saved = ReadScene(temp / "knee");
  EXPECT_NEAR(saved.portals.incision_spacing, -0.02, 1e-15);
  EXPECT_NEAR(saved.scope.view_angle, RadiansFromDegrees(70), 1e-12);
}

TEST_F(Commands, ASlidersDragIsOneStep) {
  Open();
  state.dragging = true;
  for (int mm = 30; mm <= 50; ++mm) SetIncisionSpacing(state, MetresFromMm(mm));
  EndDrag(state);
  app::Run(state, "undo");
  EXPECT_NEAR(state.document().scene.portals.incision_spacing, 0.03, 1e-15);
  EXPECT_FALSE(state.history.CanUndo());
}

TEST_F(Commands, AnEditThatChangesNothingIsNoStep) {
  Open();
  SetIncisionSpacing(state, state.document().scene.portals.incision_spacing);
  SetDepthOptions(state, state.document().depth_options, "nothing");
  SetTissue(state, 0, state.document().scene.tissues[0], "Move");
  EXPECT_FALSE(state.history.CanUndo());
}

TEST_F(Commands, AnEditOfATissuesRightsIsAStep) {
  Open();
  Tissue changed = state.document().scene.tissues[0];
  changed.rights.licence = "CC-BY-4.0";
  SetTissue(state, 0, changed, "Change the rights of");
  EXPECT_EQ(state.document().scene.tissues[0].rights.licence, "CC-BY-4.0");
  app::Run(state, "undo");
  EXPECT_EQ(state.document().scene.tissues[0].rights.licence, "");
}

TEST_F(Commands, TheProgramsOwnDemoIsNeverSavedInPlace) {
  OpenScene(state, fs::path(ARTHRO_SOURCE_DIR) / "resources/demo");
  Settle(state);
  EXPECT_FALSE(state.document().scene.title.empty());
  EXPECT_TRUE(state.document().folder.empty());
}

TEST_F(Commands, SavingOverASceneThatOthersChangedAsksFirst) {
  Open();
  SetIncisionSpacing(state, 0.01);
  SaveElsewhere("theirs");
  app::Run(state, "save");
  Settle(state);
  EXPECT_EQ(ReadScene(temp / "knee").title, "theirs");
  EXPECT_FALSE(state.history.IsSaved());
  ASSERT_EQ(state.dialogs.size(), 1u);
  ASSERT_TRUE(std::holds_alternative<ChangedOnDiskDialog>(state.dialogs.back()));
  state.dialogs.clear();

  bool went_on = false;
  ReplaceChangedScene(state, [&](EditorState&) { went_on = true; });
  Settle(state);
  EXPECT_EQ(ReadScene(temp / "knee").title, "Small knee");
  EXPECT_TRUE(went_on);
  EXPECT_TRUE(state.history.IsSaved());
  // This window knows what it has written itself.
  SetIncisionSpacing(state, 0.02);
  app::Run(state, "save");
  Settle(state);
  EXPECT_TRUE(state.dialogs.empty());
  EXPECT_TRUE(state.history.IsSaved());
}

TEST_F(Commands, SavingASceneThatWasOnlyTouchedOrWasRemovedAsksNothing) {
  Open();
  SetIncisionSpacing(state, 0.01);
  fs::last_write_time(temp / "knee/scene.json", fs::file_time_type::clock::now());
  app::Run(state, "save");
  Settle(state);
  EXPECT_TRUE(state.dialogs.empty());
  EXPECT_TRUE(state.history.IsSaved());
  fs::remove(temp / "knee/scene.json");
  SetIncisionSpacing(state, 0.02);
  app::Run(state, "save");
  Settle(state);
  EXPECT_TRUE(state.dialogs.empty());
  EXPECT_TRUE(state.history.IsSaved());
}

TEST_F(Commands, RightsOfPanoramaAndTissueAreStepsThatCanBeUndone) {
  Open();
  const authoring::Asset kPanorama, kTissue{authoring::Asset::Kind::kTissue, 0, ""};
  SetRights(state, kPanorama, {"ward 3", "CC BY 4.0", ""}, "licence");
  SetRights(state, kTissue, {"made in code", "", ""}, "source");
  EXPECT_EQ(state.document().scene.backdrop.rights.licence, "CC BY 4.0");
  EXPECT_EQ(state.document().scene.tissues[0].rights.source, "made in code");
  state.history.Undo();
  EXPECT_EQ(state.document().scene.tissues[0].rights.source, "");
  EXPECT_EQ(state.document().scene.backdrop.rights.licence, "CC BY 4.0");
  SetRights(state, kPanorama, {"ward 3", "CC BY 4.0", ""}, "licence");
  state.history.Undo();
  EXPECT_EQ(state.document().scene.backdrop.rights.licence, "") << "no step without a change";
}

TEST_F(Commands, ASecondSceneFileIsNotSavedOverTheFirst) {
  test::WriteSmallScene(temp / "knee");
  fs::copy_file(temp / "knee/scene.json", temp / "knee/variant.json");
  OpenScene(state, temp / "knee/variant.json");
  Settle(state);
  SetTitle(state, "variant");
  app::Run(state, "save");
  Settle(state);
  EXPECT_EQ(ReadScene(temp / "knee").title, "Small knee");
  ASSERT_EQ(state.dialogs.size(), 1u);
  EXPECT_TRUE(std::holds_alternative<ChangedOnDiskDialog>(state.dialogs.back()));
}

TEST_F(Commands, TheListOfRecentScenesIsItsOwnersAlone) {
  RecentScenes recent(temp / "config/recent.json");
  recent.Add(temp / "knee");
  const auto rights = fs::status(temp / "config/recent.json").permissions();
  EXPECT_EQ(rights & fs::perms(0077), fs::perms::none);
}

TEST_F(Commands, AnUnreadableFileIsToldInADialogAndChangesNothing) {
  Open();
  const std::string before = Print(state);
  std::ofstream(temp / "broken.png") << "this is no picture";
  ImportPanorama(state, temp / "broken.png");
  Settle(state);
  ASSERT_EQ(state.dialogs.size(), 1u);
  const auto* error = std::get_if<ErrorDialog>(&state.dialogs.back());
  ASSERT_TRUE(error);
  EXPECT_NE(error->sentence.find("broken.png"), std::string::npos) << error->sentence;
  EXPECT_EQ(Print(state), before);
  EXPECT_FALSE(state.history.CanUndo());
}

TEST_F(Commands, QuittingWithUnsavedChangesAsksFirst) {
  Open();
  SetIncisionSpacing(state, 0.01);
  app::Run(state, "quit");
  EXPECT_FALSE(state.quit);
  ASSERT_EQ(state.dialogs.size(), 1u);
  auto* guard = std::get_if<GuardDialog>(&state.dialogs.back());
  ASSERT_TRUE(guard);
  guard->then(state);
  EXPECT_TRUE(state.quit);
}

TEST_F(Commands, QuittingWithNothingUnsavedDoesNotAsk) {
  Open();
  app::Run(state, "quit");
  EXPECT_TRUE(state.quit);
}

TEST_F(Commands, ANewDocumentHasNothingToSave) {
  app::Run(state, "new");
  app::Run(state, "quit");
  EXPECT_TRUE(state.quit);
}

TEST_F(Commands, ASceneWithoutATitleGetsTheNameUnderWhichItIsSaved) {
  StartDocument(state, NewDocument(), true, {});
  SaveSceneAs(state);
  const auto browse = std::get<BrowseDialog>(std::move(state.dialogs.back()));
  state.dialogs.clear();
  browse.then(state, temp / "left knee.arthro");
  EXPECT_EQ(state.document().scene.title, "left knee");
  Settle(state);
  app::Run(state, "undo");
  EXPECT_EQ(state.document().scene.title, "Untitled");
}

}  // namespace
}  // namespace arthro::app

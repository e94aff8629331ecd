// The command layer without a window: what a user can have done, and that it can be undone.
#include <chrono>
#include <fstream>
#include <set>
#include <thread>
#include <tuple>

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include "app/editor/every_step.h"
#include "app/files/scene_files.h"
#include "app/state/command.h"
#include "app/state/edits.h"
#include "app/steps/budget/frame_budget.h"
#include "app/steps/depth/depth_step.h"
#include "app/steps/panorama/panorama_step.h"
#include "app/steps/portals/portals_step.h"
#include "app/steps/practice/film.h"
#include "app/steps/practice/hand_motion.h"
#include "app/steps/practice/practice_step.h"
#include "app/steps/practice/rig_edit.h"
#include "app/steps/tissue/library/tissue_library.h"
#include "app/steps/tissue/tissue_balls.h"
#include "app/steps/tissue/tissue_step.h"
#include "simulation/core/units.h"
#include "simulation/scene/json/scene_json.h"
#include "tests/app/commands/settle.h"
#include "tests/support/build_paths.h"
#include "tests/support/small_scene.h"
#include "tests/support/temp_folder.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;

std::string Print(const EditorState& state) {
  return PrettyJson(JsonFromScene(state.document().scene));
}

class Commands : public testing::Test {
 protected:
  void Open() {
    OpenScene(state, test::WriteSmallScene(temp / "knee"));
    Settle(state);
    ASSERT_TRUE(state.dialogs.empty());
  }
  // With a depth map that was made from the picture; the scene's own is an imported one.
  void OpenAndMakeDepth() {
    Open();
    app::Run(state, "make-depth");
    Settle(state);
    app::Run(state, "save");
    Settle(state);
    OpenScene(state, temp / "knee");
    Settle(state);
    ASSERT_FALSE(state.document().is_depth_imported);
    ASSERT_FALSE(state.history.CanUndo());
  }
  // Saves as another window would, unknown to this one.
  void SaveElsewhere(const std::string& title) {
    Scene scene = ReadScene(temp / "knee");
    scene.title = title;
    WriteScene(temp / "knee/scene.json", scene);
  }
  test::TempFolder temp;
  EditorState state = MakeEditorState(NewDocument());
};

TEST_F(Commands, AnImportedSurfaceIsPlacedFirst) {
  Open();
  state.steps.tissue->page = TissuePage::kCut;
  ImportSurface(state, "cartilage", *state.document().surfaces.front(), "m");
  EXPECT_EQ(state.step, Step::kTissue);
  EXPECT_EQ(state.steps.tissue->page, TissuePage::kPlace);
}

// Said what the command does, which is no reason.
TEST_F(Commands, ACommandThatCannotBeCalledByNameSaysWhy) {
  const auto why = [&](const char* id, const fs::path& file = {}) {
    return RunByName(state, id, file);
  };
  EXPECT_NE(why("depth-map").find("the scene has no picture"), std::string::npos)
      << why("depth-map");
  Open();
  EXPECT_NE(why("head-left").find("on a page that is not open"), std::string::npos);
  SetTitle(state, "another");
  EXPECT_NE(why("open", temp / "knee").find("the scene has changes that are not saved"),
            std::string::npos);
  EXPECT_NE(why("new").find("save it before you open another scene"), std::string::npos);
  state.dialogs.clear();
  app::Run(state, "save");
  ASSERT_TRUE(state.jobs.busy());
  EXPECT_NE(why("open", temp / "knee").find("put \"wait job\" on the line before"),
            std::string::npos);
  Settle(state);
  app::Run(state, "practise");
  Settle(state);
  ASSERT_TRUE(state.practice);
  EXPECT_NE(why("save").find("a practice is under way"), std::string::npos);
}

TEST_F(Commands, APageOfACommandThatIsCalledByNameIsOpened) {
  Open();
  EXPECT_EQ(RunByName(state, "touch-preview", {}), "");
  EXPECT_TRUE(TouchesRelief(state));
  EXPECT_EQ(RunByName(state, "touch-preview", {}), "");
  EXPECT_FALSE(TouchesRelief(state));
  EXPECT_EQ(RunByName(state, "library", {}), "");
  EXPECT_EQ(state.step, Step::kTissue);
  EXPECT_TRUE(state.steps.tissue->shelf->is_open);
  EXPECT_EQ(RunByName(state, "depth-scope", {}), "");
  EXPECT_EQ(state.step, Step::kDepth);
  EXPECT_EQ(RunByName(state, "budget", {}), "");
  EXPECT_EQ(state.step, Step::kPractice);
  EXPECT_TRUE(state.steps.practice->budget->is_shown);
  EXPECT_EQ(RunByName(state, "step-depth", {}), "");
  EXPECT_EQ(RunByName(state, "new-rig", {}), "");
  EXPECT_EQ(state.step, Step::kPractice);
  EXPECT_TRUE(state.steps.practice->rig->is_shown);
  EXPECT_NE(RunByName(state, "forget-lengths", {}), "") << "there are none";
}

TEST(CommandList, EveryCommandHasItsOwnIdWordsAndHelp) {
  const EditorState state = MakeEditorState(NewDocument());
  std::set<std::string> ids;
  for (const Command& command : AllCommands()) {
    EXPECT_TRUE(ids.insert(command.id).second) << command.id;
    EXPECT_STRNE(command.words, "");
    EXPECT_STREQ(std::string(command.help).substr(std::string(command.help).size() - 1).c_str(),
                 ".")
        << command.id << ": the help is a sentence";
    EXPECT_EQ(&CommandOf(state, command.id), &command);
  }
}

// Held keys count with Shift too, and not with Ctrl.
TEST(CommandList, NoTwoCommandsOrHeldKeysShareAKey) {
  std::set<std::tuple<int, bool, bool>> called;
  std::set<int> bare;
  for (const Command& command : AllCommands())
    for (const Shortcut& shortcut : {command.shortcut, command.other_shortcut}) {
      if (shortcut.key == 0) continue;
      EXPECT_TRUE(called.insert({shortcut.key, shortcut.ctrl, shortcut.shift}).second)
          << command.id << ": " << WordsOf(shortcut);
      if (!shortcut.ctrl) bare.insert(shortcut.key);
    }
  std::vector<std::pair<std::string, int>> held{{"jaws", kActKey}, {"dead-man", kDeadManKey}};
  for (const HandMotion& motion : HandMotions()) held.emplace_back(motion.words, motion.key);
  std::set<int> keys;
  for (const auto& [words, key] : held) {
    EXPECT_TRUE(keys.insert(key).second) << words;
    EXPECT_EQ(bare.count(key), 0u) << words;
  }
  EXPECT_EQ(kActKey, GLFW_KEY_C);
  EXPECT_EQ(kDeadManKey, GLFW_KEY_V);
}

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

TEST_F(Commands, DepthFollowsItsOptionsAndBothAreUndoneAtOnce) {
  OpenAndMakeDepth();
  const auto before = state.document().depth;
  authoring::DepthOptions options = state.document().depth_options;
  options.near_relief = 0.008;
  SetDepthOptions(state, options, "Near relief");
  EXPECT_TRUE(DepthIsUnderWay(state));
  EndDrag(state);
  Settle(state);
  ASSERT_NE(state.document().depth, before);
  const auto after = state.document().depth;
  float nearest = 0;
  for (const float h : after->relief)
    if (h > nearest) nearest = h;
  EXPECT_NEAR(nearest, 0.008, 1e-6) << "the range is filled";

  app::Run(state, "undo");
  EXPECT_EQ(state.document().depth, before);
  EXPECT_FALSE(state.history.CanUndo()) << "one step, though the depth came later";
  app::Run(state, "redo");
  EXPECT_EQ(state.document().depth, after);
  EXPECT_FALSE(DepthIsUnderWay(state)) << "nothing is computed twice";
}

TEST_F(Commands, WhileASliderIsHeldOnlyAPreviewIsMade) {
  OpenAndMakeDepth();
  const auto before = state.document().depth;
  authoring::DepthOptions options = state.document().depth_options;
  state.dragging = true;
  options.near_relief = 0.009;
  SetDepthOptions(state, options, "Near relief");
  for (int i = 0; i < 60000 && !state.steps.depth->cache.preview; ++i) {
    FinishWork(state);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  ASSERT_TRUE(state.steps.depth->cache.preview);
  for (int i = 0; i < 50; ++i) {
    FinishWork(state);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_EQ(state.document().depth, before);
  EndDrag(state);
  Settle(state);
  EXPECT_NE(state.document().depth, before);
}

TEST_F(Commands, OptionsThatContradictEachOtherAreToldAndKeepTheDepth) {
  OpenAndMakeDepth();
  const auto before = state.document().depth;
  authoring::DepthOptions options = state.document().depth_options;
  options.low_percentile = 60;
  options.high_percentile = 40;
  SetDepthOptions(state, options, "Low percentile");
  EndDrag(state);
  Settle(state);
  EXPECT_EQ(state.document().depth, before);
  EXPECT_NE(state.steps.depth->cache.ProblemOf(state.document()), "");
  EXPECT_TRUE(state.dialogs.empty()) << "a slider on its way is no reason for a dialog";
  app::Run(state, "undo");
  EXPECT_EQ(state.steps.depth->cache.ProblemOf(state.document()), "");
}

TEST_F(Commands, SavingWaitsForTheDepthOfTheOptions) {
  OpenAndMakeDepth();
  authoring::DepthOptions options = state.document().depth_options;
  options.near_relief = 0.004;
  SetDepthOptions(state, options, "Near relief");
  app::Run(state, "save");
  Settle(state);
  ASSERT_TRUE(state.history.IsSaved());
  const LoadedScene saved = LoadScene(temp / "knee");
  float nearest = 0;
  for (const float h : saved.depth->relief)
    if (h > nearest) nearest = h;
  EXPECT_NEAR(nearest, 0.004, 1e-6);
}

TEST_F(Commands, AnImportedDepthMapIsReplacedOnlyWhenThatIsAskedForAndIsUndone) {
  Open();
  const auto imported = state.document().depth;
  ASSERT_TRUE(state.document().is_depth_imported);
  authoring::DepthOptions options = state.document().depth_options;
  options.near_relief = 0.008;
  SetDepthOptions(state, options, "Near relief");
  EndDrag(state);
  Settle(state);
  EXPECT_EQ(state.document().depth, imported);
  EXPECT_FALSE(state.history.CanUndo());
  EXPECT_NE(state.message.find("imported depth map is kept"), std::string::npos);

  app::Run(state, "make-depth");
  Settle(state);
  EXPECT_NE(state.document().depth, imported);
  app::Run(state, "undo");
  EXPECT_EQ(state.document().depth, imported);
  EXPECT_FALSE(state.history.CanUndo()) << "one step";
  app::Run(state, "redo");
  Settle(state);
  SetDepthOptions(state, options, "Near relief");
  Settle(state);
  app::Run(state, "undo");
  app::Run(state, "undo");
  EXPECT_EQ(state.document().depth, imported);
}

TEST_F(Commands, AnotherDepthMapDropsTheErrorAndTheOriginsOfTheImportedOne) {
  Open();
  const auto sigma = Share(DepthMap(400, 300, 0.0005f));
  Edit(state, "Measure", "", [&](authoring::Document& next) {
    next.depth_sigma = sigma;
    next.depth_origin = Share(OriginMap(400, 300, ReliefOrigin::kMeasured));
  });
  SetTitle(state, "Other");
  EXPECT_EQ(state.document().depth_sigma, sigma);
  app::Run(state, "make-depth");
  Settle(state);
  ASSERT_TRUE(state.document().depth_sigma) << "a depth map from brightness states its own";
  EXPECT_NE(state.document().depth_sigma, sigma);
  EXPECT_FALSE(state.document().depth_origin);
  app::Run(state, "undo");
  EXPECT_EQ(state.document().depth_sigma, sigma);
  EXPECT_TRUE(state.document().depth_origin);
  WriteColourImage(temp / "other.png", test::KneePicture(200, 100));
  ImportPanorama(state, temp / "other.png");
  Settle(state);
  ASSERT_TRUE(state.document().depth_sigma);
  EXPECT_EQ(state.document().depth_sigma->width, 200);
}

TEST_F(Commands, AnImportedDepthMapStaysImportedInASavedScene) {
  Open();
  SetTitle(state, "Other");
  app::Run(state, "save");
  Settle(state);
  OpenScene(state, temp / "knee");
  Settle(state);
  EXPECT_TRUE(state.document().is_depth_imported);
  // One that a person puts in the place of a made one is imported as well.
  app::Run(state, "make-depth");
  Settle(state);
  app::Run(state, "save");
  Settle(state);
  const fs::path map = temp / "knee" / state.document().scene.backdrop.depth;
  WriteDepthMap(map, DepthMap(400, 300, 0.002f));
  OpenScene(state, temp / "knee");
  Settle(state);
  EXPECT_TRUE(state.document().is_depth_imported);
}

TEST_F(Commands, AnotherPictureOfTheSameSizeKeepsAnImportedDepthMap) {
  Open();
  const auto imported = state.document().depth;
  WriteColourImage(temp / "same.png", test::KneePicture(400, 300, 5.0));
  ImportPanorama(state, temp / "same.png");
  Settle(state);
  EXPECT_EQ(state.document().depth, imported);
  WriteColourImage(temp / "other.png", test::KneePicture(200, 100));
  ImportPanorama(state, temp / "other.png");
  Settle(state);
  EXPECT_EQ(state.document().depth->width, 200);
  app::Run(state, "undo");
  EXPECT_EQ(state.document().depth, imported);
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

TEST_F(Commands, APanoramaBecomesTheBackdropWithADepthMapOfItsOwn) {
  WriteColourImage(temp / "new.png", test::KneePicture(200, 100));
  ImportPanorama(state, temp / "new.png");
  Settle(state);
  ASSERT_TRUE(state.document().panorama);
  EXPECT_EQ(state.document().panorama->width, 200);
  ASSERT_TRUE(state.document().depth);
  EXPECT_EQ(state.document().depth->width, 200);
  EXPECT_FALSE(state.history.IsSaved());
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

TEST_F(Commands, AReportOfAnotherPanoramaIsRefused) {
  Open();
  std::ofstream(temp / "r.json")
      << R"({"panorama":{"width":800,"height":300,"focal_px":500,"cx":1,"cy":2}})";
  EXPECT_THROW(ReadPanoramaReport(state, temp / "r.json"), Error);
  std::ofstream(temp / "r.json")
      << R"({"panorama":{"width":400,"height":300,"focal_px":500,"cx":1,"cy":2}})";
  ReadPanoramaReport(state, temp / "r.json");
  EXPECT_DOUBLE_EQ(state.document().scene.backdrop.projection.focal_px, 500);
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

// An empty file is refused before anything is asked about it.
TEST_F(Commands, ASurfaceThatCannotBeReadIsRefusedBeforeItsUnitIsAsked) {
  Open();
  std::ofstream(temp / "empty.obj");
  AskForUnit(state, temp / "empty.obj");
  Settle(state);
  ASSERT_EQ(state.dialogs.size(), 1u);
  ASSERT_TRUE(std::holds_alternative<ErrorDialog>(state.dialogs.back()));
  EXPECT_NE(std::get<ErrorDialog>(state.dialogs.back()).sentence.find("empty"), std::string::npos);
}

TEST_F(Commands, ATissueBehindTheReliefIsFoundAndBroughtBack) {
  Open();
  EXPECT_FALSE(IsHidden(state, 0));
  Tissue changed = state.document().scene.tissues[0];
  changed.pose.position *= 3.0;
  SetTissue(state, 0, changed, "Move");
  EndDrag(state);
  EXPECT_TRUE(IsHidden(state, 0));
  app::Run(state, "tissue-before-scope");
  EXPECT_FALSE(IsHidden(state, 0));
  app::Run(state, "undo");
  EXPECT_TRUE(IsHidden(state, 0));
  EXPECT_FALSE(IsHidden(state, 7)) << "there is none";
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

TEST(Film, APictureBecomesNumberedPictures) {
  EXPECT_EQ(NumberedPictures("a/practice.png"), "a/practice-%04d.png");
  EXPECT_EQ(NumberedPictures("a/frame-%03d.png"), "a/frame-%03d.png");
  EXPECT_EQ(NumberedPictures("a/practice.mp4"), "a/practice.mp4");
}

TEST_F(Commands, ASurfaceIsReadInItsUnitAndLaidBeforeTheScope) {
  Open();
  SurfaceMesh mesh = test::Octahedron(5.0);  // mm
  for (auto& x : mesh.vertices) x += glm::dvec3(100, 0, 0);
  WriteSurface(temp / "part.ply", mesh);
  AskForUnit(state, temp / "part.ply");
  Settle(state);
  ASSERT_EQ(state.dialogs.size(), 1u);
  const auto dialog = std::get<UnitDialog>(state.dialogs.back());
  state.dialogs.clear();
  EXPECT_DOUBLE_EQ(dialog.longest_side, 10.0);
  EXPECT_EQ(dialog.unit, "mm");
  ImportSurface(state, "part", *dialog.surface, dialog.unit);
  ASSERT_EQ(state.document().scene.tissues.size(), 2u);
  EXPECT_EQ(state.tissue, 1);
  EXPECT_EQ(state.document().scene.tissues[1].name, "part");
  const auto& surface = *state.document().surfaces[1];
  EXPECT_NEAR(glm::length(surface.vertices[0]), 0.005, 1e-12) << "5 mm about its own middle";
  EXPECT_GT(state.document().scene.tissues[1].pose.position.z, 0.01);

  app::Run(state, "duplicate-tissue");
  EXPECT_EQ(state.document().scene.tissues[2].name, "part 2");
  EXPECT_EQ(state.document().surfaces[2], state.document().surfaces[1]) << "shared, not copied";
  app::Run(state, "remove-tissue");
  app::Run(state, "remove-tissue");
  EXPECT_EQ(state.document().scene.tissues.size(), 1u);
  app::Run(state, "undo");
  EXPECT_EQ(state.document().scene.tissues.size(), 2u);
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

TEST_F(Commands, BallsThatHoldATissueAreAddedMovedAndReleasedStepByStep) {
  Open();
  state.tissue = 0;
  state.steps.tissue->ball_radius = 0.003;
  AddBall(state, BallKind::kHeld, 0, {0.006, 0, 0});
  AddBall(state, BallKind::kHeld, 0, {0, 0.006, 0});
  const auto& fixed = [&]() -> const std::vector<Ball>& {
    return state.document().scene.tissues[0].fixed;
  };
  ASSERT_EQ(fixed().size(), 2u);
  EXPECT_EQ(state.steps.tissue->ball, 1);
  EXPECT_EQ(fixed()[0], (Ball{{0.006, 0, 0}, 0.003}));
  SetBall(state, BallKind::kHeld, 0, 1, {{0, 0.006, 0}, 0.001}, "Change a ball of");
  EXPECT_EQ(fixed()[1].radius, 0.001);
  EndDrag(state);
  app::Run(state, "undo");
  EXPECT_EQ(fixed()[1].radius, 0.003);
  app::Run(state, "undo");
  EXPECT_EQ(fixed().size(), 1u) << "each ball is a step of its own";
  app::Run(state, "redo");
  state.steps.tissue->ball = 0;
  state.steps.tissue->page = TissuePage::kHold;
  app::Run(state, "release-ball");
  ASSERT_EQ(fixed().size(), 1u);
  EXPECT_EQ(fixed()[0].centre, glm::dvec3(0, 0.006, 0));
  app::Run(state, "release-tissue");
  EXPECT_TRUE(fixed().empty());
  EXPECT_FALSE(CommandOf(state, "release-tissue").enabled(state));
  app::Run(state, "undo");
  EXPECT_EQ(fixed().size(), 1u);
}

TEST_F(Commands, ProbedPlacesAreBallsOfTheirOwn) {
  Open();
  state.tissue = 0;
  state.steps.tissue->page = TissuePage::kMesh;
  state.steps.tissue->ball_radius = 0.0015;
  AddBall(state, BallKind::kHeld, 0, {0.006, 0, 0});
  AddBall(state, BallKind::kProbed, 0, {0, 0.006, 0});
  const auto& tissue = [&]() -> const Tissue& { return state.document().scene.tissues[0]; };
  EXPECT_EQ(tissue().fixed, (std::vector<Ball>{{{0.006, 0, 0}, 0.0015}}));
  EXPECT_EQ(tissue().probed, (std::vector<Ball>{{{0, 0.006, 0}, 0.0015}}));
  EXPECT_EQ(state.steps.tissue->ball, 0);
  EXPECT_FALSE(CommandOf(state, "release-ball").enabled(state))
      << "the page is about the probed ones";
  app::Run(state, "remove-probed");
  EXPECT_TRUE(tissue().probed.empty());
  EXPECT_EQ(tissue().fixed.size(), 1u);
  EXPECT_EQ(state.history.UndoName(), "Take a probed place from " + tissue().name);
  app::Run(state, "undo");
  app::Run(state, "remove-all-probed");
  EXPECT_TRUE(tissue().probed.empty());
  EXPECT_FALSE(CommandOf(state, "remove-all-probed").enabled(state));
  app::Run(state, "probe-brush");
  EXPECT_EQ(state.steps.tissue->brush, BallKind::kProbed);
  app::Run(state, "hold-brush");
  EXPECT_EQ(state.steps.tissue->brush, BallKind::kHeld) << "one brush at a time";
  app::Run(state, "hold-brush");
  EXPECT_FALSE(state.steps.tissue->brush);
}

TEST_F(Commands, ABallAtTheInstrumentLiesAtItsTipInTheTissuesOwnFrame) {
  Open();
  state.tissue = 0;
  Tissue turned = state.document().scene.tissues[0];
  turned.pose.quaternion = glm::angleAxis(0.7, glm::normalize(glm::dvec3(1, 2, 3)));
  turned.pose.scale = 2;
  SetTissue(state, 0, turned, "Turn");
  app::Run(state, "hold-at-instrument");
  const Tissue& tissue = state.document().scene.tissues[0];
  ASSERT_EQ(tissue.fixed.size(), 1u);
  const glm::dvec3 tip = glm::dvec3(0.03, 0, 0) + simulation::TipInOwnPortal(state.instrument);
  EXPECT_LT(glm::distance(tissue.pose * tissue.fixed[0].centre, tip), 1e-12);
  EXPECT_NEAR(tissue.fixed[0].radius * 2, state.steps.tissue->ball_radius, 1e-15);
}

TEST_F(Commands, MaterialsArePresetsAndWhatTheSceneSaysOtherwise) {
  Open();
  state.steps.tissue->preset_folder = fs::path(ARTHRO_SOURCE_DIR) / "resources/presets/tissues";
  LoadTissuePresets(state);
  ASSERT_EQ(state.tissue_presets.size(), 6u);
  const auto tissue = [&]() -> const Tissue& { return state.document().scene.tissues[0]; };
  Elasticity own;
  own.young_modulus = 3e5;
  SetElasticity(state, 0, own, "Change");
  EXPECT_EQ(PresetOf(state, tissue())->material.young_modulus, 3e5);
  EXPECT_EQ(PresetOf(state, tissue())->material.fibre_stiffness, 2e7);
  own.young_modulus = 5e5;  // the preset's own
  SetElasticity(state, 0, own, "Change");
  EXPECT_EQ(tissue().elasticity, Elasticity{});
  own.poisson_ratio = 0.3;
  SetElasticity(state, 0, own, "Change");
  EndDrag(state);
  ChoosePreset(state, 0, "cartilage-literature");
  EXPECT_EQ(tissue().elasticity, Elasticity{});
  EXPECT_EQ(PresetOf(state, tissue())->material.young_modulus, 1.5e7);
  app::Run(state, "undo");
  EXPECT_EQ(tissue().material, "meniscus");
  EXPECT_EQ(tissue().elasticity.poisson_ratio, 0.3);
  Tissue unknown = tissue();
  unknown.material = "jelly";
  EXPECT_FALSE(PresetOf(state, unknown));
}

TEST_F(Commands, ABrokenPresetIsToldOnce) {
  Open();
  std::ofstream(temp / "bad.json") << "{";
  state.steps.tissue->preset_folder = temp.path();
  LoadTissuePresets(state);
  LoadTissuePresets(state);
  EXPECT_EQ(state.dialogs.size(), 1u);
}

// The poke's session has the author's hands: the instrument stops at the tissue, and the force is
// felt.
TEST_F(Commands, PokingHoldsTheInstrumentOutOfTheTissueUntilAnEditEndsIt) {
  Open();
  app::Run(state, "poke");
  Settle(state);
  ASSERT_TRUE(state.steps.practice->poke);
  ASSERT_FALSE(state.practice);
  EXPECT_EQ(LiveSession(state), &*state.steps.practice->poke);
  // Towards the joint's surface until it must have met it.
  state.instrument = {0.0, -0.5, 0.0, 0.046};
  MoveHands(state, {}, {0, 0, 0, 0.001});
  for (int i = 0; i < 30; ++i) state.steps.practice->poke->Advance(0.016);
  EXPECT_GT(glm::length(state.steps.practice->poke->snapshot().instrument.tip_force), 0.05);
  EXPECT_EQ(state.instrument.depth, 0.047) << "the author's own hand is what moved";
  FinishWork(state);
  EXPECT_TRUE(state.steps.practice->poke);
  SetTitle(state, "another");
  FinishWork(state);
  EXPECT_FALSE(state.steps.practice->poke);
  app::Run(state, "poke");
  Settle(state);
  ASSERT_TRUE(state.steps.practice->poke);
  app::Run(state, "poke");
  EXPECT_FALSE(state.steps.practice->poke) << "the same command ends it";
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

// Undo, saves, earlier versions and recent scenes of a session.
#include <chrono>
#include <fstream>
#include <unistd.h>

#include <gtest/gtest.h>

#include "app/editor/every_step.h"
#include "app/files/earlier_versions.h"
#include "app/files/scene_checklist.h"
#include "app/files/scene_files.h"
#include "app/platform/resource_folder.h"
#include "app/state/edits.h"
#include "app/steps/portals/portals_step.h"
#include "app/steps/tissue/tissue_step.h"
#include "authoring/project/document_io.h"
#include "simulation/core/atomic_file.h"
#include "tests/app/commands/settle.h"
#include "tests/support/build_paths.h"
#include "tests/support/small_scene.h"
#include "tests/support/temp_folder.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;

class UndoSession : public testing::Test {
 protected:
  UndoSession() {
    test::WriteSmallScene(temp / "knee");
    StartDocument(state, authoring::OpenDocument(temp / "knee"), true, NoteOnDisk(temp / "knee"));
    state.steps.tissue->preset_folder = fs::path(ARTHRO_SOURCE_DIR) / "resources/presets/tissues";
    LoadTissuePresets(state);
  }
  void Settle() { app::Settle(state); }
  std::string ErrorOnTop() const {
    const auto* error =
        state.dialogs.empty() ? nullptr : std::get_if<ErrorDialog>(&state.dialogs.back());
    return error ? error->sentence : "";
  }

  test::TempFolder temp;
  EditorState state = MakeEditorState(NewDocument());
};

// Tetrahedra that are made again do not take the place of those that undo brings back.
TEST_F(UndoSession, AProductThatIsMadeAgainGetsAFileOfItsOwn) {
  const fs::path first = state.scratch.NewFile("meniscus.vtu");
  std::ofstream(first) << "coarse";
  const fs::path second = state.scratch.NewFile("meniscus.vtu");
  EXPECT_NE(first, second);
  EXPECT_EQ(first.extension(), second.extension());
}

TEST_F(UndoSession, AnEarlierSaveComesBackAsAnEditThatIsUndone) {
  for (const double spacing : {0.011, 0.012, 0.013}) {
    SetIncisionSpacing(state, spacing);
    EndDrag(state);
    app::Run(state, "save");
    Settle();
  }
  app::Run(state, "history");
  ASSERT_EQ(state.dialogs.size(), 1u) << ErrorOnTop();
  const auto versions = std::get<HistoryDialog>(state.dialogs.back()).versions;
  state.dialogs.clear();
  ASSERT_EQ(versions.size(), 3u);
  ReturnToVersion(state, versions[1]);
  Settle();
  EXPECT_EQ(state.document().scene.portals.incision_spacing, 0.011);
  EXPECT_EQ(state.document().folder, temp / "knee");
  app::Run(state, "save");
  Settle();
  EXPECT_TRUE(state.history.IsSaved());
  app::Run(state, "undo");
  EXPECT_EQ(state.document().scene.portals.incision_spacing, 0.013);
}

TEST_F(UndoSession, ASnapshotIsSavedByNameAndANameIsTakenOnce) {
  SetIncisionSpacing(state, 0.011);
  EndDrag(state);
  KeepSnapshotOf(state, "Before the tear");
  Settle();
  EXPECT_EQ(ErrorOnTop(), "");
  KeepSnapshotOf(state, "Before the tear");
  Settle();
  ASSERT_EQ(state.dialogs.size(), 1u);
  EXPECT_NE(std::get<ErrorDialog>(state.dialogs.back()).sentence.find("choose another name"),
            std::string::npos);
  EXPECT_EQ(authoring::VersionsOf(temp / "knee").front().name, "Before the tear");
}

// Two windows on one scene, in one process or two.
TEST_F(UndoSession, ASceneThatAnotherWindowHasIsTold) {
  EXPECT_TRUE(state.lock.is_held());
  EditorState second = MakeEditorState(NewDocument());
  StartDocument(second, authoring::OpenDocument(temp / "knee"), true);
  ASSERT_EQ(second.dialogs.size(), 1u);
  const auto dialog = std::get<OpenElsewhereDialog>(second.dialogs.back());
  EXPECT_NE(dialog.who.find("process " + std::to_string(::getpid())), std::string::npos)
      << dialog.who;
  EditCopy(second);
  EXPECT_TRUE(second.document().folder.empty());
  EXPECT_TRUE(second.history.IsSaved());
  // The first window goes on to another scene.
  StartDocument(state, NewDocument(), true);
  EXPECT_FALSE(fs::exists(temp / "knee/.scene.lock"));
  second.dialogs.clear();
  StartDocument(second, authoring::OpenDocument(temp / "knee"), true);
  EXPECT_TRUE(second.dialogs.empty());
  EXPECT_TRUE(second.lock.is_held());
}

// 2147480000 is above every number that a process can have.
TEST_F(UndoSession, UnfinishedFilesOfASessionThatWasKilledGoWhenTheSceneIsOpened) {
  const fs::path old_file = temp / "knee/..scene.backup-1.2147480000.partial.json",
                 new_file = temp / "knee/.scene.2147480000.partial.json";
  for (const fs::path& file : {old_file, new_file}) std::ofstream(file) << "{";
  fs::last_write_time(old_file, fs::file_time_type::clock::now() - std::chrono::minutes(5));
  EditorState second = MakeEditorState(NewDocument());
  StartDocument(second, authoring::OpenDocument(temp / "knee"), true);
  EXPECT_TRUE(fs::exists(old_file)) << "another window may be writing";
  StartDocument(state, NewDocument(), true);
  StartDocument(second, authoring::OpenDocument(temp / "knee"), true);
  EXPECT_FALSE(fs::exists(old_file));
  EXPECT_TRUE(fs::exists(new_file)) << "a process of another machine may be writing";
}

TEST_F(UndoSession, AFolderThatCannotBeWrittenIsOpenedWithoutAMark) {
  if (::geteuid() == 0) GTEST_SKIP() << "SKIPPED: the administrator writes anywhere";
  StartDocument(state, NewDocument(), true);
  fs::permissions(temp / "knee", fs::perms::owner_read | fs::perms::owner_exec);
  StartDocument(state, authoring::OpenDocument(temp / "knee"), true);
  EXPECT_FALSE(state.lock.is_held());
  EXPECT_TRUE(state.dialogs.empty());
  SetIncisionSpacing(state, 0.011);
  app::Run(state, "save");
  Settle();
  ASSERT_EQ(state.dialogs.size(), 1u);
  EXPECT_TRUE(std::holds_alternative<ErrorDialog>(state.dialogs.back()));
  fs::permissions(temp / "knee", fs::perms::owner_all);
}

TEST_F(UndoSession, RecentScenesNameASceneOnceHoweverItWasOpened) {
  RecentScenes recent(temp / "recent.json");
  recent.Add(temp / "knee");
  recent.Add(temp / "knee/scene.json");
  recent.Add(temp.path().string() + "/knee/");
  EXPECT_EQ(recent.Existing(), (std::vector<fs::path>{temp / "knee"}));
  EXPECT_EQ(RecentScenes(temp / "recent.json").Existing(), recent.Existing());
}

TEST_F(UndoSession, TheLayoutOfTheViewsIsRememberedAndABrokenFileGivesTheDefaults) {
  const fs::path file = temp / "config/views.json";
  const ViewLayout layout{ViewLayout::Shown::kOverview, 0.6, true};
  WriteViewLayout(file, layout);
  EXPECT_EQ(ReadViewLayout(file), layout);
  for (const char* text : {"", "{", "{\"overview_share\": \"wide\"}", "[]", R"({"shown": "other"})",
                           R"({"overview_share": 1e999})"}) {
    std::ofstream(file) << text;
    EXPECT_EQ(ReadViewLayout(file), ViewLayout()) << text;
  }
  std::ofstream(file) << R"({"overview_share": 7, "swapped": true, "shown": "scope"})";
  EXPECT_EQ(ReadViewLayout(file),
            (ViewLayout{ViewLayout::Shown::kScope, ViewLayout::kMostShare, true}));
}

TEST_F(UndoSession, WhatASceneLacksIsListedWithThePageThatMendsIt) {
  const auto sentences = [&] {
    std::string all;
    for (const MissingPart& part : MissingParts(state)) all += part.sentence + "\n";
    return all;
  };
  EXPECT_EQ(sentences(),
            "It names no author.\n\"octahedron\" has no tetrahedra: it does not give way.\n");
  GoToMissingPart(state, MissingParts(state).back());
  EXPECT_EQ(state.step, Step::kTissue);
  EXPECT_EQ(state.tissue, 0);
  EXPECT_EQ(state.steps.tissue->page, TissuePage::kMesh);
  SetAuthor(state, "A. Surgeon");
  ChoosePreset(state, 0, "cartilage");
  EXPECT_EQ(sentences(), "") << "a thin layer needs no tetrahedra";
  RemoveTissue(state, 0);
  EXPECT_EQ(sentences(), "There is no tissue to probe or to cut.\n");
  EXPECT_EQ(MissingParts(MakeEditorState(NewDocument())).front().sentence,
            "There is no panorama yet.");
}

TEST_F(UndoSession, ASceneOfTheProgramIsSavedElsewhere) {
  StartDocument(state, OpenSceneDocument(fs::path(ARTHRO_SOURCE_DIR) / "resources/demo"), true);
  state.recent.Add(fs::path(ARTHRO_SOURCE_DIR) / "resources/demo");
  app::Run(state, "save-as");
  ASSERT_EQ(state.dialogs.size(), 1u);
  const fs::path start = std::get<BrowseDialog>(state.dialogs.back()).model.folder();
  EXPECT_FALSE(IsInResourceFolder(start)) << start;
}

TEST_F(UndoSession, TheProgramsOwnScenesAreNeverReplaced) {
  const fs::path demo = fs::path(ARTHRO_SOURCE_DIR) / "resources/demo";
  authoring::Document document = state.document();
  document.folder = demo;
  state.history.Push(document, "Stray");
  app::Run(state, "save");
  Settle();
  ASSERT_EQ(state.dialogs.size(), 1u);
  EXPECT_NE(std::get<ErrorDialog>(state.dialogs.back()).sentence.find("choose another folder"),
            std::string::npos);
}

}  // namespace
}  // namespace arthro::app

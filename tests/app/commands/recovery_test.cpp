// The copy of unsaved work (app/files): when it is written, and when it goes.
#include <chrono>
#include <csignal>
#include <fstream>
#include <limits>
#include <sys/resource.h>
#include <thread>

#include <gtest/gtest.h>

#include "app/editor/every_step.h"
#include "app/files/recovery_copy.h"
#include "app/files/scene_files.h"
#include "app/state/edits.h"
#include "app/steps/depth/depth_step.h"
#include "app/steps/portals/portals_step.h"
#include "app/steps/practice/practice_step.h"
#include "authoring/project/document_io.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/units.h"
#include "tests/support/small_scene.h"
#include "tests/support/temp_folder.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;

class Recovery : public testing::Test {
 protected:
  Recovery() { StartDocument(state, authoring::OpenDocument(scene), true); }
  // The write that is under way, if any, is over.
  void FollowUntilWritten(RecoveryCopy& copy, double now) {
    copy.Follow(state, now);
    for (int i = 0; i < 2000 && Copies() == 0; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  int Copies() const {
    int count = 0;
    std::error_code ignored;
    for (const auto& session : fs::directory_iterator(folder, ignored))
      count += fs::exists(session.path() / "scene/scene.json");
    return count;
  }
  test::TempFolder temp;
  fs::path scene = test::WriteSmallScene(temp / "knee"), folder = temp / "state" / "recovery";
  EditorState state = MakeEditorState(NewDocument());
};

TEST_F(Recovery, IsWrittenAfterTheLastChangeAndNotBefore) {
  RecoveryCopy copy(folder);
  copy.Follow(state, 0);
  EXPECT_EQ(copy.SecondsUntilDue(0), std::numeric_limits<double>::infinity());
  SetIncisionSpacing(state, -0.02);
  copy.Follow(state, 1.0);
  EXPECT_NEAR(copy.SecondsUntilDue(1.1), RecoveryCopy::kAfterChange - 0.1, 1e-9);
  SetIncisionSpacing(state, -0.021);
  copy.Follow(state, 1.2);
  copy.Follow(state, 1.4);
  EXPECT_EQ(Copies(), 0);
  FollowUntilWritten(copy, 1.6);
  EXPECT_EQ(Copies(), 1);
}

TEST_F(Recovery, IsWrittenWhileChangesGoOn) {
  RecoveryCopy copy(folder);
  double now = 0;
  for (; now <= RecoveryCopy::kAtLeastEvery; now += 0.1) {
    SetIncisionSpacing(state, 0.02 + 1e-4 * now);
    copy.Follow(state, now);
  }
  FollowUntilWritten(copy, now);
  EXPECT_EQ(Copies(), 1);
}

TEST_F(Recovery, GoesWhenAllIsSavedUndoneOrDiscarded) {
  {
    RecoveryCopy copy(folder);
    SetIncisionSpacing(state, -0.02);
    EXPECT_TRUE(copy.WriteNow(state));
    EXPECT_EQ(Copies(), 1);
    state.history.Undo();
    copy.Follow(state, 100);
    EXPECT_EQ(Copies(), 0);
    state.history.Redo();
    EXPECT_TRUE(copy.WriteNow(state));
    state.history.MarkSaved();
    copy.Follow(state, 200);
    EXPECT_EQ(Copies(), 0);
    SetIncisionSpacing(state, -0.03);
    EXPECT_TRUE(copy.WriteNow(state));
    copy.Remove();
    EXPECT_EQ(Copies(), 0);
    EXPECT_TRUE(copy.WriteNow(state));
  }
  EXPECT_EQ(Copies(), 1) << "an end that nobody asked for";
}

TEST_F(Recovery, GivesBackEveryUnsavedValueAndIsNotOfferedTwice) {
  {
    RecoveryCopy copy(folder);
    SetIncisionSpacing(state, -0.02);
    ASSERT_TRUE(copy.WriteNow(state));
  }
  RecoveryCopy copy(folder), other(folder);
  EditorState next = MakeEditorState(NewDocument());
  copy.Offer(next);
  ASSERT_EQ(next.dialogs.size(), 1u);
  auto dialog = std::get<RecoveryDialog>(next.dialogs.back());
  EXPECT_EQ(dialog.title, "Small knee");
  EXPECT_EQ(dialog.folder, scene);
  EditorState second = MakeEditorState(NewDocument());
  other.Offer(second);
  EXPECT_TRUE(second.dialogs.empty()) << "another window has it";

  next.dialogs.clear();
  dialog.restore(next);
  EXPECT_DOUBLE_EQ(next.document().scene.portals.incision_spacing, -0.02);
  EXPECT_EQ(next.document().folder, scene);
  EXPECT_FALSE(next.history.IsSaved());
  EXPECT_EQ(Copies(), 1) << "kept until another copy holds it";
  ASSERT_TRUE(copy.WriteNow(next));
  EXPECT_EQ(Copies(), 1) << "the other one";
  next.history.MarkSaved();
  copy.Follow(next, 1);
  EXPECT_EQ(Copies(), 0);
}

TEST_F(Recovery, TellsWhatItHoldsAndGivesBackADepthThatWasUnderWay) {
  {
    RecoveryCopy copy(folder);
    SetIncisionSpacing(state, -0.02);
    EndDrag(state);
    app::Run(state, "make-depth");
    ASSERT_TRUE(DepthIsUnderWay(state));
    ASSERT_TRUE(copy.WriteNow(state));
  }
  RecoveryCopy copy(folder);
  EditorState next = MakeEditorState(NewDocument());
  copy.Offer(next);
  ASSERT_EQ(next.dialogs.size(), 1u);
  auto dialog = std::get<RecoveryDialog>(next.dialogs.back());
  EXPECT_EQ(dialog.edits, 2);
  EXPECT_EQ(dialog.last_edit, "Replace the imported depth map");
  EXPECT_EQ(dialog.problem, "");
  dialog.restore(next);
  EXPECT_FALSE(next.document().is_depth_imported);
  EXPECT_TRUE(DepthIsUnderWay(next)) << "made anew from the picture";
  EXPECT_FALSE(next.document().scene.extensions.contains(kRecoveryKey));
}

TEST_F(Recovery, KeepsTheKeysOfOtherTools) {
  authoring::Document document = state.document();
  document.scene.extensions["x-other"] = "[1,2]";
  state.history.Push(document, "Other");
  RecoveryCopy copy(folder);
  ASSERT_TRUE(copy.WriteNow(state));
  for (const auto& session : fs::directory_iterator(folder))
    EXPECT_EQ(authoring::OpenDocument(session.path() / "scene").scene.extensions.at("x-other"),
              "[1,2]");
}

// Another version's copy, and one that a broken disk has cut.
TEST_F(Recovery, OneThatCannotBeRestoredIsToldInASentenceAndStays) {
  {
    RecoveryCopy copy(folder);
    SetIncisionSpacing(state, -0.02);
    ASSERT_TRUE(copy.WriteNow(state));
  }
  const fs::path file = fs::directory_iterator(folder)->path() / "scene/scene.json";
  const std::string whole = ReadWholeFile(file);
  const auto problem = [&](const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
    RecoveryCopy copy(folder);
    EditorState next = MakeEditorState(NewDocument());
    copy.Offer(next);
    return next.dialogs.empty() ? "" : std::get<RecoveryDialog>(next.dialogs.back()).problem;
  };
  std::string newer = whole;
  newer.replace(newer.find("arthroscene.recovery/2"), 22, "arthroscene.recovery/9");
  EXPECT_NE(problem(newer).find("Another version of the program left this copy"),
            std::string::npos);
  for (const std::size_t bytes : {std::size_t{0}, std::size_t{1}, whole.size() / 2})
    EXPECT_NE(problem(whole.substr(0, bytes)).find("is damaged and cannot be restored"),
              std::string::npos)
        << bytes;
  EXPECT_EQ(problem(whole), "");
}

TEST_F(Recovery, OfAnEarlierVersionIsRestored) {
  const fs::path session = folder / "session-abcdef";
  fs::create_directories(session);
  SetIncisionSpacing(state, -0.02);
  authoring::SaveDocument(state.document(), session / "scene.arthro");
  std::ofstream(session / "about.json")
      << R"({"schema": "arthroscene.recovery/1", "title": "Small knee", "folder": ""})";
  RecoveryCopy copy(folder);
  EditorState next = MakeEditorState(NewDocument());
  copy.Offer(next);
  ASSERT_EQ(next.dialogs.size(), 1u);
  auto dialog = std::get<RecoveryDialog>(next.dialogs.back());
  EXPECT_EQ(dialog.problem, "");
  dialog.restore(next);
  EXPECT_DOUBLE_EQ(next.document().scene.portals.incision_spacing, -0.02);
}

TEST_F(Recovery, OfASceneThatChangedOnDiskSinceIsSavedElsewhere) {
  {
    RecoveryCopy copy(folder);
    SetIncisionSpacing(state, -0.02);
    ASSERT_TRUE(copy.WriteNow(state));
  }
  fs::last_write_time(scene / "scene.json",
                      fs::file_time_type::clock::now() + std::chrono::seconds(5));
  RecoveryCopy copy(folder);
  EditorState next = MakeEditorState(NewDocument());
  copy.Offer(next);
  ASSERT_EQ(next.dialogs.size(), 1u);
  std::get<RecoveryDialog>(next.dialogs.back()).restore(next);
  EXPECT_EQ(next.document().folder, fs::path());
}

TEST_F(Recovery, AFullDiskKeepsTheCopyBeforeAndTheNextChangeIsTriedAgain) {
  RecoveryCopy copy(folder);
  SetIncisionSpacing(state, -0.02);
  ASSERT_TRUE(copy.WriteNow(state));
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit usual{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &usual), 0);
  rlimit full = usual;
  full.rlim_cur = 100;  // bytes
  setrlimit(RLIMIT_FSIZE, &full);
  SetIncisionSpacing(state, -0.021);
  EXPECT_FALSE(copy.WriteNow(state));
  setrlimit(RLIMIT_FSIZE, &usual);
  std::signal(SIGXFSZ, handler);
  const auto kept = [&] {
    const fs::path scene_of_copy = fs::directory_iterator(folder)->path() / "scene";
    return authoring::OpenDocument(scene_of_copy).scene.portals.incision_spacing;
  };
  EXPECT_DOUBLE_EQ(kept(), -0.02);
  SetIncisionSpacing(state, -0.022);
  EXPECT_TRUE(copy.WriteNow(state));
  EXPECT_DOUBLE_EQ(kept(), -0.022);
}

TEST_F(Recovery, AFolderThatCannotBeWrittenIsToldAndStopsNothing) {
  { std::ofstream(temp / "state") << "a file"; }
  RecoveryCopy copy(folder);
  SetIncisionSpacing(state, -0.02);
  EXPECT_FALSE(copy.WriteNow(state));
  copy.Follow(state, 0);
  copy.Follow(state, 100);
  for (int i = 0; i < 1000 && state.message.find("no recovery copy") == std::string::npos; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    copy.Follow(state, 100);
  }
  EXPECT_NE(state.message.find("no recovery copy"), std::string::npos) << state.message;
}

}  // namespace
}  // namespace arthro::app

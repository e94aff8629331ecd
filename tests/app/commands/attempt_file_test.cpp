// Attempts and recorded hands that the window opens from a file, without its pictures.
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "app/editor/every_step.h"
#include "app/files/browse_preview.h"
#include "app/files/scene_files.h"
#include "app/platform/resource_folder.h"
#include "app/state/edits.h"
#include "app/steps/lessons/keeping/lesson_records.h"
#include "app/steps/lessons/keeping/start_board.h"
#include "app/steps/lessons/lessons_step.h"
#include "app/steps/lessons/trainee.h"
#include "tests/app/commands/lesson_test.h"
#include "tests/app/commands/settle.h"
#include "tests/support/temp_folder.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;

class AttemptFiles : public testing::Test {
 protected:
  AttemptFiles() { Prepare(state); }
  // The log of an attempt at the first exercise, which another window began and stopped.
  fs::path Log(FinishedAttempt& finished) {
    EditorState other = MakeEditorState(OpenSceneDocument(ResourceFolder() / "demo"));
    Prepare(other);
    OpenLessons(other, (folder / "records.sqlite").string());
    other.steps.lessons->start->unknown = "T-1";
    AddTraineeCode(other);
    other.steps.lessons->chosen = 0;
    app::Run(other, "begin-exercise");
    Settle(other);
    for (int i = 0; i < 90 && other.practice; ++i) {
      other.practice->Advance(1.0 / 60);
      FollowAttempt(other);
    }
    app::Run(other, "leave-practice");
    finished = *other.steps.lessons->finished;
    const fs::path log = folder / "sent.attempt";
    fs::copy_file(finished.log, log);
    return log;
  }
  void Open(const fs::path& file) {
    Guarded(state, "Open an attempt", [&] { OpenAttemptFile(state, file); });
    Settle(state);
  }
  std::string Fault() const {
    const auto* error =
        state.dialogs.empty() ? nullptr : std::get_if<ErrorDialog>(&state.dialogs.back());
    return error != nullptr ? error->sentence : "";
  }
  const std::optional<FinishedAttempt>& shown() const { return state.steps.lessons->finished; }

  test::TempFolder folder;
  EditorState state = MakeEditorState(OpenSceneDocument(ResourceFolder() / "demo"));
};

TEST_F(AttemptFiles, AnAttemptOfAnotherStationIsJudgedAsWhileItRan) {
  FinishedAttempt own;
  Open(Log(own));
  ASSERT_TRUE(shown()) << Fault();
  EXPECT_EQ(state.steps.lessons->page, LessonPage::kSummary);
  EXPECT_EQ(shown()->exercise, own.exercise);
  EXPECT_EQ(shown()->result.outcome, own.result.outcome);
  ASSERT_EQ(shown()->result.metrics.size(), own.result.metrics.size());
  for (std::size_t i = 0; i < own.result.metrics.size(); ++i)
    EXPECT_EQ(shown()->result.metrics[i].value, own.result.metrics[i].value)
        << own.result.metrics[i].metric->id;
  EXPECT_EQ(shown()->kept,
            "From the file sent.attempt; it is not in the records and counts for nothing.");
  EXPECT_TRUE(shown()->id.empty());
  app::Run(state, "attempt-debrief");
  EXPECT_EQ(state.steps.lessons->page, LessonPage::kDebrief);
  EXPECT_NE(DebriefFrame(state), nullptr);
}

TEST_F(AttemptFiles, ADroppedAttemptIsOpenedAndItsPreviewNamesTheExercise) {
  FinishedAttempt own;
  const fs::path log = Log(own);
  EXPECT_NE(ReadFilePreview(log).words.find("Exercise " + own.exercise.id + " of the scene"),
            std::string::npos);
  OpenDropped(state, log);
  Settle(state);
  EXPECT_TRUE(shown()) << Fault();
}

TEST_F(AttemptFiles, RecordedHandsAreJudgedByTheChosenExercise) {
  const fs::path hands = ResourceFolder() / "demo" / "trace.csv";
  Open(hands);
  EXPECT_FALSE(shown());
  EXPECT_NE(Fault().find("first choose it on the page Exercises"), std::string::npos) << Fault();
  state.dialogs.clear();
  state.steps.lessons->chosen = 0;
  Open(hands);
  ASSERT_TRUE(shown()) << Fault();
  EXPECT_FALSE(shown()->frames.empty());
  EXPECT_EQ(shown()->exercise, state.document().scene.exercises.front());
}

// The dialog asked for an exercise, as for recorded hands.
TEST_F(AttemptFiles, APictureUnderTheNameOfAnAttemptIsNoRecording) {
  const fs::path picture = folder / "picture.attempt", empty = folder / "empty.attempt";
  fs::copy_file(ResourceFolder() / "demo" / "panorama.jpg", picture);
  std::ofstream(empty).close();
  Open(picture);
  EXPECT_NE(Fault().find("this is no recording of the program"), std::string::npos) << Fault();
  Open(empty);
  EXPECT_NE(Fault().find("this file is empty"), std::string::npos) << Fault();
}

TEST_F(AttemptFiles, WhatIsNoAttemptOfThisSceneIsRefusedInASentence) {
  FinishedAttempt own;
  const fs::path log = Log(own), broken = folder / "broken.attempt", text = folder / "text.csv";
  fs::copy_file(log, broken);
  fs::resize_file(broken, 40);
  std::ofstream(text) << "no, table\n";
  state.steps.lessons->chosen = 0;
  for (const fs::path& file : {broken, text, folder / "missing.attempt", folder.path()}) {
    Open(file);
    EXPECT_FALSE(shown()) << file;
    EXPECT_NE(Fault(), "") << file;
    state.dialogs.clear();
  }
  Edit(state, "Move", "", [](authoring::Document& document) {
    document.scene.portals.incision_spacing += 1e-3;
    document.scene.backdrop.radius *= 1.1;
  });
  Open(log);
  EXPECT_FALSE(shown());
  EXPECT_NE(Fault().find("scene"), std::string::npos) << Fault();
  state.dialogs.clear();
  Edit(state, "Remove", "", [](authoring::Document& document) {
    document.scene.exercises.erase(document.scene.exercises.begin());
  });
  Open(log);
  EXPECT_NE(Fault().find("has no such exercise; open that scene first"), std::string::npos)
      << Fault();
}

TEST_F(AttemptFiles, ASceneWithoutExercisesOpensNone) {
  Edit(state, "Remove", "",
       [](authoring::Document& document) { document.scene.exercises.clear(); });
  EXPECT_FALSE(MayOpenAttempt(state));
  EXPECT_THROW(OpenAttemptFile(state, folder / "any.attempt"), Error);
}

}  // namespace
}  // namespace arthro::app

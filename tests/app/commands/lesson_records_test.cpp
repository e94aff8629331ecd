// Attempts in the window and their records: every outcome is kept, and the log gives the result of
// the attempt again.
#include "app/steps/lessons/keeping/lesson_records.h"

#include <gtest/gtest.h>

#include "app/editor/every_step.h"
#include "app/files/scene_files.h"
#include "app/platform/resource_folder.h"
#include "app/steps/lessons/attempt.h"
#include "app/steps/lessons/running_attempt.h"
#include "app/steps/lessons/trainee.h"
#include "app/steps/practice/practice_step.h"
#include "app/steps/tissue/tissue_step.h"
#include "tests/app/commands/settle.h"
#include "tests/support/temp_folder.h"

namespace arthro::app {
namespace {

// A window on the demo scene with records of its own.
struct Window {
  test::TempFolder folder;
  std::string place = (folder / "records.sqlite").string();
  EditorState state = MakeEditorState(OpenSceneDocument(ResourceFolder() / "demo"));
  Window() {
    state.steps.practice->pace = simulation::TissuePace::kInline;
    state.steps.tissue->preset_folder = ResourceFolder() / "presets" / "tissues";
    LoadTissuePresets(state);
    OpenLessons(state, place);
  }
  LessonsStep& step() { return *state.steps.lessons; }
  void Practise(int frames) {
    step().chosen = 0;
    app::Run(state, "begin-exercise");
    Settle(state);
    ASSERT_TRUE(state.practice);
    for (int i = 0; i < frames && state.practice; ++i) {
      state.practice->Advance(1.0 / 60);
      FollowAttempt(state);
    }
  }
  std::vector<AttemptRecord> Kept(const std::string& code) {
    Records records(place);
    return AttemptsOf(records, code);
  }
};

TEST(LessonRecords, ACodeThatNobodyHasIsAddedOnlyWhenAsked) {
  Window window;
  TakeTraineeCode(window.state, "T-77");
  EXPECT_EQ(window.step().start->unknown, "T-77");
  EXPECT_EQ(window.step().records->trainee, "");
  AddTraineeCode(window.state);
  EXPECT_EQ(window.step().records->trainee, "T-77");
  ChangeTrainee(window.state);
  TakeTraineeCode(window.state, "T-77");
  EXPECT_EQ(window.step().records->trainee, "T-77") << "it is known now";
}

TEST(LessonRecords, ANameIsNoCode) {
  Window window;
  TakeTraineeCode(window.state, "Jane Doe");
  EXPECT_NE(window.step().start->fault.find("must not be a name"), std::string::npos);
  EXPECT_EQ(window.step().records->trainee, "");
}

TEST(LessonRecords, AStoppedAttemptIsKeptWithTheResultThatItsLogGivesAgain) {
  Window window;
  window.step().start->unknown = "T-1";
  AddTraineeCode(window.state);
  window.step().is_test = true;
  window.Practise(90);
  app::Run(window.state, "leave-practice");  // Esc
  const FinishedAttempt& finished = *window.step().finished;
  EXPECT_EQ(finished.kept, "Kept for T-1 in the records.");
  const auto kept = window.Kept("T-1");
  ASSERT_EQ(kept.size(), 1U);
  EXPECT_EQ(kept[0].outcome, AttemptOutcome::kStopped);
  EXPECT_EQ(kept[0].mode, AttemptMode::kTest);
  EXPECT_FALSE(kept[0].log_sha256.empty());
  Records records(window.place);
  const auto again = ResultFromLog(records, kept[0]);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->events, finished.result.events);
  EXPECT_EQ(again->reason, finished.result.reason);
  ASSERT_EQ(again->metrics.size(), finished.result.metrics.size());
  for (std::size_t i = 0; i < again->metrics.size(); ++i) {
    EXPECT_EQ(again->metrics[i].value, finished.result.metrics[i].value)
        << again->metrics[i].metric->id;
    EXPECT_EQ(again->metrics[i].why_none, finished.result.metrics[i].why_none);
  }
}

TEST(LessonRecords, AnAttemptUnderWayWhenTheProgramEndsIsKept) {
  Window window;
  window.step().start->unknown = "T-1";
  AddTraineeCode(window.state);
  window.Practise(30);
  EndLessons(window.state);
  ASSERT_EQ(window.Kept("T-1").size(), 1U);
  EXPECT_EQ(window.Kept("T-1")[0].outcome, AttemptOutcome::kStopped);
}

TEST(LessonRecords, WithoutATraineeNothingIsKeptAndTheWindowSaysSo) {
  Window window;
  window.Practise(5);
  EXPECT_NE(window.state.message.find("not kept"), std::string::npos);
  app::Run(window.state, "leave-practice");
  EXPECT_FALSE(std::filesystem::exists(window.place));
}

TEST(LessonRecords, OfANewerSchemaLeaveTheAttemptInTheOutbox) {
  Window window;
  {
    Records records(window.place);
    records.database().Do("UPDATE meta SET value = '99' WHERE key = 'schema'");
  }
  TakeTraineeCode(window.state, "T-1");
  window.Practise(5);
  EXPECT_NE(window.state.message.find("schema 99"), std::string::npos) << window.state.message;
  app::Run(window.state, "leave-practice");
  EXPECT_NE(window.step().finished->kept.find("outbox"), std::string::npos);
}

TEST(StartBoard, ShowsTriesAndWhichExerciseMustComeFirst) {
  Window window;
  window.step().start->unknown = "T-1";
  AddTraineeCode(window.state);
  window.Practise(5);
  app::Run(window.state, "leave-practice");
  const StartBoard& board = FreshStartBoard(window.state);
  const auto& exercises = window.state.document().scene.exercises;
  ASSERT_EQ(board.rows.size(), exercises.size());
  EXPECT_EQ(board.rows[0].tries, 1);
  EXPECT_TRUE(board.rows[0].is_open);
  EXPECT_EQ(board.attempts.size(), 1U);
  for (std::size_t i = 0; i < exercises.size(); ++i)
    EXPECT_EQ(board.rows[i].is_open, exercises[i].needs.empty()) << exercises[i].id;
}

}  // namespace
}  // namespace arthro::app

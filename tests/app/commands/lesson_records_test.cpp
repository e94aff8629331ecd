// Attempts in the window and their records: every outcome is kept, and the log gives the result of
// the attempt again.
#include "app/steps/lessons/keeping/lesson_records.h"

#include <cstdlib>
#include <fstream>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "app/editor/every_step.h"
#include "app/files/scene_files.h"
#include "app/platform/resource_folder.h"
#include "app/state/edits.h"
#include "app/steps/lessons/attempt.h"
#include "app/steps/lessons/running_attempt.h"
#include "app/steps/lessons/trainee.h"
#include "app/steps/practice/practice_step.h"
#include "app/steps/tissue/tissue_step.h"
#include "authoring/project/document_io.h"
#include "simulation/core/atomic_file.h"
#include "simulation/scene/files/scene_io.h"
#include "simulation/training/attempt_log.h"
#include "simulation/training/robot/robot_hands.h"
#include "simulation/training/track/track_recorder.h"
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

TEST(LessonRecords, AnAttemptThatNothingTookIsNotLostToTheNextOne) {
  Window window;
  window.step().start->unknown = "T-1";
  AddTraineeCode(window.state);
  window.Practise(5);
  // Neither the records nor the outbox nor the data folder of this user can be written.
  const auto block = [&](const char* name) {
    std::ofstream(window.folder / name) << "a file in the place of the folder";
  };
  block("outbox");
  block("data");
  ::setenv("XDG_DATA_HOME", (window.folder / "data").c_str(), 1);
  {
    Records records(window.place);
    records.database().Do("UPDATE meta SET value = '99' WHERE key = 'schema'");
  }
  app::Run(window.state, "leave-practice");
  EXPECT_TRUE(HasUnkeptAttempt(window.state));
  app::Run(window.state, "begin-exercise");
  EXPECT_FALSE(window.state.practice);
  ASSERT_EQ(window.state.dialogs.size(), 1U);
  EXPECT_TRUE(HasUnkeptAttempt(window.state));
  Database(window.place, 1).Do("UPDATE meta SET value = '1' WHERE key = 'schema'");
  app::Run(window.state, "keep-attempt");
  EXPECT_EQ(window.Kept("T-1").size(), 1U);
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

// One stopped attempt of T-1 in the records.
struct WithAttempt : Window {
  WithAttempt() {
    step().start->unknown = "T-1";
    AddTraineeCode(state);
    Practise(90);
    app::Run(state, "leave-practice");
  }
  std::string id() { return Kept("T-1").at(0).id; }
};

TEST(StoredAttempt, IsShownWithTheResultAndTheFramesThatItHadAfterThePractice) {
  WithAttempt window;
  const FinishedAttempt after = *window.step().finished;
  ASSERT_FALSE(after.frames.empty());
  window.step().finished.reset();
  ShowStoredAttempt(window.state, window.id());
  const FinishedAttempt& shown = *window.step().finished;
  EXPECT_EQ(window.step().page, LessonPage::kSummary);
  EXPECT_EQ(shown.notice, "");
  EXPECT_EQ(shown.exercise, after.exercise);
  EXPECT_EQ(shown.trainee, "T-1");
  EXPECT_TRUE(shown.frames == after.frames);
  EXPECT_EQ(shown.result.outcome, after.result.outcome);
  EXPECT_EQ(shown.result.reason, after.result.reason);
  EXPECT_EQ(shown.result.events, after.result.events);
  EXPECT_EQ(shown.result.steps.size(), after.result.steps.size());
  ASSERT_EQ(shown.result.criteria.size(), after.result.criteria.size());
  for (std::size_t i = 0; i < after.result.criteria.size(); ++i) {
    EXPECT_EQ(shown.result.criteria[i].value, after.result.criteria[i].value);
    EXPECT_EQ(shown.result.criteria[i].source, after.result.criteria[i].source);
    EXPECT_EQ(shown.result.criteria[i].is_start_value, after.result.criteria[i].is_start_value);
  }
  for (const simulation::MetricValue& value : after.result.metrics)
    EXPECT_NE(std::ranges::find(shown.result.metrics, value), shown.result.metrics.end())
        << value.metric->id << " " << value.part;
  app::Run(window.state, "attempt-debrief");
  EXPECT_NE(DebriefFrame(window.state), nullptr);
}

// Tissue of the practice at a moment in which it was recorded.
struct SeenTissue {
  double t = 0;  // s of the attempt
  std::vector<glm::dvec3> positions;
};

// Presses the front of the meniscus with the probe. Returns its places at each record of it.
std::vector<SeenTissue> PressMeniscus(Window& window, int frames) {
  std::vector<SeenTissue> seen;
  const Tissue& tissue = window.state.document().scene.tissues.at(0);
  const glm::dvec3 edge = tissue.pose * glm::dvec3(0.0029, 0.0059, 0.0029);
  const glm::dvec3 portal(window.state.practice->incision_spacing(), 0, 0);
  for (int i = 0; i < frames; ++i) {
    const glm::dvec3 tip = glm::mix(portal, edge, 0.9 + 0.2 * i / frames);
    window.state.practice->instrument().Set(simulation::PoseOfTip(portal, tip, 0));
    window.state.practice->Advance(1.0 / 60);
    const std::size_t before = window.step().running->track.size();
    FollowAttempt(window.state);
    if (window.step().running->track.size() > before)
      seen.push_back({window.step().running->track.back().t,
                      window.state.practice->tissues()->bodies.at(0).positions});
  }
  return seen;
}

TEST(StoredAttempt, ShowsTheTissueAsItWasPressed) {
  Window window;
  window.step().start->unknown = "T-1";
  AddTraineeCode(window.state);
  window.Practise(5);
  const std::vector<SeenTissue> seen = PressMeniscus(window, 90);
  ASSERT_GT(seen.size(), 5U);
  app::Run(window.state, "leave-practice");
  const auto tissue_at = [&](double t) {
    window.step().debrief.at = t;
    const simulation::WorldPicture* world = DebriefTissues(window.state);
    return world == nullptr || world->bodies.empty() ? std::vector<glm::dvec3>()
                                                     : world->bodies[0].positions;
  };
  const auto expect_as_seen = [&] {
    double pressed = 0;
    const auto rest = tissue_at(0);
    for (const SeenTissue& moment : seen) {
      const auto shown = tissue_at(moment.t);
      ASSERT_EQ(shown.size(), moment.positions.size());
      for (std::size_t i = 0; i < shown.size(); ++i) {
        EXPECT_LE(glm::distance(shown[i], moment.positions[i]), simulation::kTrackStill + 1e-5);
        pressed = std::max(pressed, glm::distance(rest[i], shown[i]));
      }
    }
    EXPECT_GT(pressed, 4e-4) << "the probe moved the meniscus";
  };
  app::Run(window.state, "attempt-debrief");
  expect_as_seen();
  ShowStoredAttempt(window.state, window.Kept("T-1").at(0).id);
  EXPECT_EQ(window.step().finished->notice, "");
  EXPECT_EQ(DebriefTissues(window.state), nullptr) << "the result is shown, not the look back";
  app::Run(window.state, "attempt-debrief");
  expect_as_seen();
}

TEST(Expert, OfTheSceneStandsBesideAnAttemptAtTheSameStep) {
  WithAttempt window;
  ShowStoredAttempt(window.state, window.id());
  EXPECT_FALSE(CommandOf(window.state, "use-as-expert").enabled(window.state)) << "not passed";
  app::Run(window.state, "attempt-debrief");
  EXPECT_EQ(ExpertFrame(window.state), nullptr);
  EXPECT_NE(window.step().debrief.expert_words.find("Use as expert's"), std::string::npos);
  window.step().finished->result.outcome = simulation::AttemptOutcome::kPassed;
  app::Run(window.state, "use-as-expert");
  const Exercise& exercise = *ChosenExercise(window.state);
  EXPECT_EQ(exercise.ghost, "expert-centre-and-hold.attempt");
  EXPECT_EQ(FreshStartBoard(window.state).rows.at(0).tries, 1) << "it is the same exercise still";

  ShowStoredAttempt(window.state, window.id());
  app::Run(window.state, "attempt-debrief");
  const simulation::AttemptFrame* expert = ExpertFrame(window.state);
  ASSERT_NE(expert, nullptr) << window.step().debrief.expert_words;
  EXPECT_EQ(*expert, *DebriefFrame(window.state)) << "it is the same attempt";

  // The recording goes with the scene, and its file names nobody.
  const std::filesystem::path copy = window.folder / "copy";
  authoring::SaveDocument(window.state.document(), copy);
  const LoadedScene saved = LoadScene(copy);
  const std::string bytes = ReadWholeFile(FileOf(saved, saved.scene.exercises.at(0).ghost));
  EXPECT_EQ(bytes.find("T-1"), std::string::npos);
  app::Run(window.state, "undo");
  EXPECT_TRUE(ChosenExercise(window.state)->ghost.empty());
}

TEST(Expert, ThatCannotBeReadLeavesOneSentence) {
  WithAttempt window;
  Edit(window.state, "Ghost", "",
       [&](authoring::Document& document) { document.scene.exercises[0].ghost = "gone.attempt"; });
  ShowStoredAttempt(window.state, window.id());
  app::Run(window.state, "attempt-debrief");
  EXPECT_EQ(ExpertFrame(window.state), nullptr);
  EXPECT_NE(window.step().debrief.expert_words.find("cannot be shown"), std::string::npos);
}

TEST(StoredAttempt, WithoutItsTissueShowsItAtRestAndSaysSo) {
  WithAttempt window;
  const std::filesystem::path file = window.folder / window.Kept("T-1").at(0).log;
  auto recorded = simulation::ReadAttempt(file);
  std::filesystem::remove(file);
  simulation::AttemptLog log(file, recorded.hands, recorded.head);
  for (const simulation::AttemptFrame& frame : recorded.frames) log.Add(frame);
  log.Close();
  ShowStoredAttempt(window.state, window.id());
  EXPECT_NE(window.step().finished->notice.find("shows it at rest"), std::string::npos);
  app::Run(window.state, "attempt-debrief");
  EXPECT_NE(DebriefFrame(window.state), nullptr);
  EXPECT_EQ(DebriefTissues(window.state), nullptr);
}

TEST(StoredAttempt, ThatWasCutShortSaysSo) {
  WithAttempt window;
  const std::filesystem::path file = window.folder / window.Kept("T-1").at(0).log;
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 100);
  ShowStoredAttempt(window.state, window.id());
  EXPECT_NE(window.step().finished->notice.find("The recording was cut short"), std::string::npos)
      << window.step().finished->notice;
  EXPECT_FALSE(window.step().finished->frames.empty());
}

TEST(StoredAttempt, OfASceneThatHasChangedSaysSo) {
  WithAttempt window;
  SetIncisionSpacing(window.state, 0.02);
  ShowStoredAttempt(window.state, window.id());
  EXPECT_NE(window.step().finished->notice.find("as it was then"), std::string::npos);
  EXPECT_FALSE(window.step().finished->frames.empty());
}

TEST(StoredAttempt, WithoutItsLogHasItsResultAndSaysWhyThereIsNoLookBack) {
  WithAttempt window;
  const std::string log = window.Kept("T-1").at(0).log;
  std::filesystem::remove(window.folder / log);
  ShowStoredAttempt(window.state, window.id());
  EXPECT_NE(window.step().finished->notice.find("look back is not there"), std::string::npos);
  EXPECT_EQ(window.step().finished->result.outcome, simulation::AttemptOutcome::kStopped);
  EXPECT_FALSE(CommandOf(window.state, "attempt-debrief").enabled(window.state));
  EXPECT_TRUE(CommandOf(window.state, "attempt-report").enabled(window.state));
}

TEST(OpenBriefing, IsForTheTraineeAndSaysWhyAnExerciseIsShut) {
  WithAttempt window;
  ChangeTrainee(window.state);
  OpenBriefing(window.state, "telescope", "T-1", true);
  EXPECT_EQ(window.step().page, LessonPage::kBriefing);
  EXPECT_TRUE(window.step().is_test);
  EXPECT_EQ(window.step().records->trainee, "T-1");
  EXPECT_NE(WhyShut(window.state).find("pass \"Centre and hold\" first"), std::string::npos);
  EXPECT_FALSE(MayBeginExercise(window.state));
  OpenBriefing(window.state, "centre-and-hold", "T-1", false);
  EXPECT_EQ(WhyShut(window.state), "");
  EXPECT_TRUE(MayBeginExercise(window.state));
  OpenBriefing(window.state, "centre-and-hold", "T-2", false);
  EXPECT_EQ(window.step().page, LessonPage::kStart) << "nobody has this code";
  EXPECT_THROW(OpenBriefing(window.state, "none", "", false), Error);
}

}  // namespace
}  // namespace arthro::app

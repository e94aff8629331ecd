// The instructor's page without its pictures: the cohort, learning curves, CUSUM as advice, an
// opened gate with its audit, and a rating.
#include <algorithm>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "app/editor/every_step.h"
#include "app/files/scene_files.h"
#include "app/platform/resource_folder.h"
#include "app/records/attempts/records_file.h"
#include "app/records/keeping/kept_attempt.h"
#include "app/records/people/audit.h"
#include "app/records/people/reference_groups.h"
#include "app/steps/lessons/instructor/cohort_board.h"
#include "app/steps/lessons/instructor/rating_board.h"
#include "app/steps/lessons/keeping/lesson_records.h"
#include "app/steps/lessons/trainee.h"
#include "simulation/core/error.h"
#include "simulation/training/metrics/metrics.h"
#include "tests/support/sample_attempts.h"
#include "tests/support/temp_folder.h"

namespace arthro::app {
namespace {

// Two trainees of a cohort and one without, with attempts at the first exercises of the demo.
struct Lab {
  test::TempFolder folder;
  std::string place = (folder / "records.sqlite").string();
  EditorState state = MakeEditorState(OpenSceneDocument(ResourceFolder() / "demo"));
  std::string first;  // id of the first attempt

  Lab() {
    Records records(place, test::RepeatedOptions());
    AddTrainee(records, test::NewTrainee("T-1", "2026"));
    AddTrainee(records, test::NewTrainee("T-2", "2026"));
    AddTrainee(records, test::NewTrainee("E-1"));
    const auto session = StartSession(records, "T-1", "test", "mouse");
    const double times[] = {90, 70, 80, 60, 50};
    for (int i = 0; i < 5; ++i) {
      const auto attempt = Add(records, session, 0, times[i], i >= 2);
      if (i == 0) first = attempt.id;
    }
    const auto expert = StartSession(records, "E-1", "test", "mouse");
    Add(records, expert, 0, 40, true);
    ReferenceRule rule;
    rule.trainees = {"E-1"};
    rule.rig = "mouse";
    MakeReferenceGroup(records, "experts", RowOf(0).hash, rule);
    OpenLessons(state, place);
  }
  ExerciseRow RowOf(std::size_t exercise) const {
    return ExerciseRowOf(state.document().scene.exercises.at(exercise));
  }
  AttemptRecord Add(Records& records, const SessionRow& session, std::size_t exercise,
                    double seconds, bool passes) const {
    auto running = StartAttempt(records, session, RowOf(exercise), "Demo", AttemptMode::kTest,
                                simulation::kMetricsVersion);
    SetResult(running.record, test::SampleResult(seconds, passes));
    FinishAttempt(records, running.record);
    return running.record;
  }
  CohortBoard& board() { return FreshCohortBoard(state); }
  int RowIndex(const std::string& code) {
    const auto& rows = board().rows;
    return static_cast<int>(std::ranges::find(rows, code, &CohortRowOfPage::code) - rows.begin());
  }
};

TEST(CohortBoard, CountsTriesAndPassesOfEveryTraineeAndShowsGates) {
  Lab lab;
  const CohortBoard& board = lab.board();
  EXPECT_EQ(board.fault, "");
  ASSERT_EQ(board.rows.size(), 3U);
  EXPECT_EQ(board.rows[0].code, "E-1");
  const CohortCell& cell = board.rows[1].cells[0];
  EXPECT_EQ(cell.tries, 5);
  EXPECT_EQ(cell.passes, 3);
  EXPECT_EQ(cell.last, "passed");
  EXPECT_TRUE(cell.is_gate_passed) << "two passes in a row are asked for";
  EXPECT_FALSE(board.rows[0].cells[0].is_gate_passed) << "one is not enough";
  EXPECT_EQ(board.rows[2].cells[0].tries, 0);
  ChooseCohort(lab.state, 0);
  EXPECT_EQ(lab.board().rows.size(), 2U);
}

TEST(CohortBoard, DrawsTheMedianOfThreeBesideTheBandOfTheGroup) {
  Lab lab;
  ChooseCell(lab.state, lab.RowIndex("T-1"), 0);
  const CohortBoard& board = lab.board();
  ASSERT_EQ(board.metrics.at(0).first, "task_time");
  ASSERT_EQ(board.curve.points.size(), 5U);
  EXPECT_EQ(board.curve.points[0].value, 90);
  EXPECT_EQ(board.curve.median[2], 80);
  EXPECT_EQ(board.curve.median[4], 60);
  ASSERT_TRUE(board.curve.band);
  EXPECT_EQ(board.curve.band->first, 40);
  EXPECT_EQ(board.curve.band_words, "experts, n = 1");
  ASSERT_EQ(board.curve.cusum.size(), 5U);
  EXPECT_NEAR(board.curve.cusum[1], 2 * 0.814, 2e-3) << "two failures";
}

TEST(CusumAdvice, FollowsTheLinesAndDecidesNothing) {
  EXPECT_NE(CusumAdvice({}).find("No attempt"), std::string::npos);
  EXPECT_NE(CusumAdvice({0.8}).find("too few"), std::string::npos);
  EXPECT_NE(CusumAdvice({0.8, 1.7}).find("more failures"), std::string::npos);
  EXPECT_NE(CusumAdvice({0.8, 1.7, 1.5}).find("getting better"), std::string::npos);
  EXPECT_NE(CusumAdvice({-1.7}).find("few enough"), std::string::npos);
  EXPECT_NE(CusumAdvice({-1.7, -0.9}).find("come back"), std::string::npos);
}

TEST(CohortBoard, OpensAGateForAReasonThatTheAuditKeeps) {
  Lab lab;
  constexpr int kTelescope = 1;  // nobody has tried it
  ChooseCell(lab.state, lab.RowIndex("T-2"), kTelescope);
  lab.board();
  EXPECT_FALSE(MayOpenGate(lab.state));
  lab.board().who = "I-2";
  lab.board().reason = "has done it elsewhere";
  ASSERT_TRUE(MayOpenGate(lab.state));
  OpenChosenGate(lab.state);
  Records records(lab.place);
  const auto audit = AuditOf(records);
  const auto entry = std::ranges::find(audit, "I-2", &AuditRow::who);
  ASSERT_NE(entry, audit.end());
  EXPECT_EQ(entry->subject, "T-2");
  EXPECT_NE(entry->action.find("has done it elsewhere"), std::string::npos);
  TakeTraineeCode(lab.state, "T-2");
  EXPECT_TRUE(FreshStartBoard(lab.state).rows[kTelescope].is_open);
}

TEST(RatingBoard, KeepsScoresWithTheAttemptAndAsksForARater) {
  Lab lab;
  ShowStoredAttempt(lab.state, lab.first);
  lab.state.steps.lessons->page = LessonPage::kDebrief;
  ASSERT_TRUE(MayRate(lab.state));
  ToggleRating(lab.state);
  RatingBoard& board = *lab.state.steps.lessons->rating;
  ASSERT_TRUE(board.is_shown);
  const RatingForm& form = board.forms.at(0);
  SetScore(board.filled, form.items.at(0).id, 3);
  SetScore(board.filled, form.items.at(0).id, 4);
  EXPECT_FALSE(MayKeepRating(lab.state)) << "nobody rates";
  board.filled.rater = "I-2";
  board.filled.blinded = true;
  ASSERT_TRUE(MayKeepRating(lab.state));
  KeepRating(lab.state);
  Records records(lab.place);
  const RecordsBundle bundle = ReadBundleOf(records, lab.first);
  ASSERT_EQ(bundle.forms.size(), 1U);
  EXPECT_EQ(bundle.forms[0].rater, "I-2");
  EXPECT_TRUE(bundle.forms[0].blinded);
  ASSERT_EQ(bundle.forms[0].items.size(), 1U);
  EXPECT_EQ(bundle.forms[0].items[0].score, 4);
}

TEST(CohortBoard, OfRecordsThatCannotBeReadSaysWhy) {
  Lab lab;
  {
    Records records(lab.place);
    records.database().Do("UPDATE meta SET value = '99' WHERE key = 'schema'");
  }
  lab.state.steps.lessons->records->open.reset();
  EXPECT_NE(lab.board().fault.find("schema 99"), std::string::npos) << lab.board().fault;
}

}  // namespace
}  // namespace arthro::app

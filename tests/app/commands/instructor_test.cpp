// The instructor's page without its pictures: the cohort, learning curves, CUSUM as advice, an
// opened gate with its audit, and a rating.
#include <algorithm>
#include <array>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "app/editor/every_step.h"
#include "app/files/scene_files.h"
#include "app/platform/resource_folder.h"
#include "app/records/attempts/records_file.h"
#include "app/records/keeping/kept_attempt.h"
#include "app/records/people/audit.h"
#include "app/records/people/reference_groups.h"
#include "app/report/make_report.h"
#include "app/state/command.h"
#include "app/steps/lessons/instructor/cohort_board.h"
#include "app/steps/lessons/instructor/rating_board.h"
#include "app/steps/lessons/keeping/lesson_records.h"
#include "app/steps/lessons/trainee.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/training/metrics/metrics.h"
#include "tests/support/many_attempts.h"
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
  ReadShownRows(lab.state, 0, 3);
  EXPECT_EQ(board.rows[0].code, "E-1");
  const CohortCell& cell = board.rows[1].cells[0];
  EXPECT_EQ(cell.tries, 5);
  EXPECT_EQ(cell.passes, 3);
  EXPECT_EQ(cell.last, "passed");
  EXPECT_TRUE(cell.is_gate_passed) << "two passes in a row are asked for";
  EXPECT_FALSE(board.rows[0].cells[0].is_gate_passed) << "one is not enough";
  EXPECT_EQ(board.rows[2].cells[0].tries, 0);
  ChooseCohort(lab.state, "2026");
  EXPECT_EQ(lab.board().rows.size(), 2U);
  FindTrainees(lab.state, "t-2");
  EXPECT_EQ(lab.board().rows.size(), 1U);
}

TEST(CohortBoard, ReadsTheSameForManyTraineesAsForFew) {
  const auto work_of = [](int trainees) {
    Lab lab;
    {
      Records records(lab.place, test::RepeatedOptions(9));
      test::FillRecords(records, {trainees, 5}, {lab.RowOf(0), lab.RowOf(1)});
    }
    OpenRecords(*lab.state.steps.lessons->records);
    const DatabaseWork& work = lab.state.steps.lessons->records->open->database().work();
    const DatabaseWork opened = work;
    lab.board();
    const DatabaseWork codes = work;
    ReadShownRows(lab.state, 0, 20);
    const DatabaseWork cells = work;
    ReadShownRows(lab.state, 5, 15);
    EXPECT_EQ(work.statements, cells.statements) << "rows that were read are read again";
    return std::array{opened.statements, codes.statements - opened.statements,
                      cells.statements - codes.statements, cells.rows - codes.rows};
  };
  // 36 rows are read for 20 that are shown.
  EXPECT_EQ(work_of(50), work_of(150));
}

// Experts and a trainee with a device, beside those with the mouse.
void AddDevice(const Lab& lab, Records& records) {
  AddTrainee(records, test::NewTrainee("E-2"));
  lab.Add(records, StartSession(records, "E-2", "test", "Touch"), 0, 30, true);
  lab.Add(records, StartSession(records, "T-2", "test", "Touch"), 0, 55, true);
  ReferenceRule rule;
  rule.trainees = {"E-2"};
  rule.rig = "Touch";
  MakeReferenceGroup(records, "experts", lab.RowOf(0).hash, rule);
}

TEST(ReferenceGroups, OfOneNameAreKeptForEachRigAndCountForItAlone) {
  Lab lab;
  Records records(lab.place, test::RepeatedOptions(9));
  AddDevice(lab, records);
  EXPECT_EQ(ReferenceGroupsOf(records).size(), 2U);
  const auto mean_time = [&](const std::string& rig) -> std::optional<double> {
    for (const auto& value : GroupValuesOf(records, lab.RowOf(0).hash, rig))
      if (value.metric == "task_time") return value.mean;
    return std::nullopt;
  };
  EXPECT_EQ(mean_time("mouse"), 40);
  EXPECT_EQ(mean_time("Touch"), 30);
  EXPECT_EQ(mean_time("mouse, zero force"), std::nullopt);
  std::string notice;
  AttemptReport report = ReportFromRecords(records, lab.first, notice);
  SetGroup(report, records, "experts");
  ASSERT_NE(StandingIn(report, "task_time", "both"), nullptr);
  EXPECT_EQ(StandingIn(report, "task_time", "both")->median, 40);
  report.rig = "pen";
  try {
    SetGroup(report, records, "experts");
    FAIL() << "a group of another rig was taken";
  } catch (const Error& refused) {
    EXPECT_NE(std::string(refused.what()).find("are not compared"), std::string::npos)
        << refused.what();
  }
}

TEST(CohortBoard, DrawsTheBandOfTheRigOfTheTrainee) {
  Lab lab;
  {
    Records records(lab.place, test::RepeatedOptions(9));
    AddDevice(lab, records);
  }
  const auto band_of = [&](const std::string& code) {
    ChooseCell(lab.state, lab.RowIndex(code), 0);
    return lab.board().curve.band;
  };
  ASSERT_TRUE(band_of("T-1"));
  EXPECT_EQ(band_of("T-1")->first, 40);
  ASSERT_TRUE(band_of("T-2"));
  EXPECT_EQ(band_of("T-2")->first, 30);
}

TEST(CohortBoard, DrawsTheBandOfTheGroupThatWasChosenAlsoAfterTheNextStart) {
  Lab lab;
  {
    Records records(lab.place);
    ReferenceRule rule;
    rule.trainees = {"T-1"};
    rule.rig = "mouse";
    MakeReferenceGroup(records, "residents", lab.RowOf(0).hash, rule);
  }
  const auto band_words = [](EditorState& state) {
    const auto& rows = FreshCohortBoard(state).rows;
    const auto trainee = std::ranges::find(rows, "T-1", &CohortRowOfPage::code);
    ChooseCell(state, static_cast<int>(trainee - rows.begin()), 0);
    return FreshCohortBoard(state).curve.band_words;
  };
  EXPECT_EQ(band_words(lab.state), "experts, n = 1");
  ChooseGroup(lab.state, "residents");
  ChooseCohort(lab.state, "2026");
  const auto next = [&] {
    EditorState state = MakeEditorState(OpenSceneDocument(ResourceFolder() / "demo"));
    OpenLessons(state, lab.place);
    const std::string words = band_words(state);
    EXPECT_EQ(FreshCohortBoard(state).choice.cohort, "2026");
    ChooseGroup(state, "");
    EXPECT_FALSE(FreshCohortBoard(state).curve.band);
    return words;
  };
  EXPECT_EQ(next(), "residents, n = 1");
  EXPECT_EQ(next(), "") << "no band was chosen";
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
  ASSERT_TRUE(MayKeepRating(lab.state));
  KeepRating(lab.state);
  Records records(lab.place);
  const RecordsBundle bundle = ReadBundleOf(records, lab.first);
  ASSERT_EQ(bundle.forms.size(), 1U);
  EXPECT_EQ(bundle.forms[0].rater, "I-2");
  EXPECT_FALSE(bundle.forms[0].blinded) << "the page has said whose attempt it is";
  ASSERT_EQ(bundle.forms[0].items.size(), 1U);
  EXPECT_EQ(bundle.forms[0].items[0].score, 4);
}

// Words of the widgets that would say whose an attempt is and how it ended.
bool SaysWhose(const EditorState& state) {
  return CommandOf(state, "attempt-summary").enabled(state) ||
         CommandOf(state, "attempt-report").enabled(state) || !IsBlinded(state);
}

TEST(RatingBoard, HidesWhoseAnAttemptIsUntilABlindedRatingIsKept) {
  Lab lab;
  EditorState& state = lab.state;
  std::string expert;
  {
    Records records(lab.place);
    expert = AttemptsOf(records, "E-1").at(0).id;
    for (const std::string& id : {lab.first, expert})
      WriteAtomically(lab.folder / LogNameOf(id), "log");
  }
  app::Run(state, "instructor-page");
  lab.board();
  EXPECT_FALSE(MayRateBlinded(state)) << "no exercise is chosen";
  ChooseCell(state, lab.RowIndex("T-1"), 0);
  lab.board().who = "I-2";
  std::set<std::string> rated;
  for (int i = 0; i < 2; ++i) {
    app::Run(state, "rate-blinded");
    ASSERT_TRUE(IsBlinded(state));
    EXPECT_FALSE(SaysWhose(state));
    EXPECT_FALSE(CommandOf(state, "rate-attempt").enabled(state));
    RatingBoard& board = *state.steps.lessons->rating;
    EXPECT_EQ(board.filled.rater, "I-2");
    EXPECT_EQ(state.message.find("T-1"), std::string::npos);
    EXPECT_EQ(state.message.find("E-1"), std::string::npos);
    rated.insert(state.steps.lessons->finished->id);
    SetScore(board.filled, board.forms.at(0).items.at(0).id, 3);
    app::Run(state, "keep-rating");
    EXPECT_FALSE(IsBlinded(state));
    EXPECT_TRUE(SaysWhose(state));
    EXPECT_NE(board.kept.find(state.steps.lessons->finished->trainee), std::string::npos);
  }
  EXPECT_EQ(rated, (std::set{lab.first, expert})) << "one was rated twice";
  app::Run(state, "rate-blinded");
  EXPECT_EQ(state.dialogs.size(), 1U) << "none is left";
  Records records(lab.place);
  for (const FormRow& form : ReadBundle(records).forms) EXPECT_TRUE(form.blinded);
}

TEST(RatingBoard, IsNotBlindedOnceTheAttemptWasOpenedFromTheList) {
  Lab lab;
  WriteAtomically(lab.folder / LogNameOf(lab.first), "log");
  app::Run(lab.state, "instructor-page");
  lab.board();
  ChooseCell(lab.state, lab.RowIndex("T-1"), 0);
  lab.board();
  app::Run(lab.state, "rate-blinded");
  ASSERT_TRUE(IsBlinded(lab.state));
  ShowStoredAttempt(lab.state, lab.first);
  EXPECT_FALSE(IsBlinded(lab.state));
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

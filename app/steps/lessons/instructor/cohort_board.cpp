#include "app/steps/lessons/instructor/cohort_board.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "app/records/attempts/records_file.h"
#include "app/records/exchange/attempt_table.h"
#include "app/records/people/reference_groups.h"
#include "app/records/people/trainees.h"
#include "app/state/command.h"
#include "app/steps/lessons/keeping/lesson_records.h"
#include "app/steps/lessons/keeping/start_board.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/scene/json/exercise_json.h"
#include "simulation/training/metrics/metrics.h"
#include "simulation/training/score/learning.h"

namespace arthro::app {
namespace {

CohortBoard& BoardOf(EditorState& state) { return *state.steps.lessons->cohort; }

const Exercise* ChosenOf(const EditorState& state, const CohortBoard& board) {
  const auto& exercises = state.document().scene.exercises;
  return board.exercise >= 0 && board.exercise < static_cast<int>(exercises.size())
             ? &exercises[static_cast<std::size_t>(board.exercise)]
             : nullptr;
}

bool HasChoice(const CohortBoard& board) {
  return board.row >= 0 && board.row < static_cast<int>(board.rows.size());
}

void ReadRows(Records& records, const EditorState& state, CohortBoard& board) {
  board.cohorts.clear();
  std::string cohort, cohort_id;
  for (const CohortRow& row : CohortsOf(records)) {
    if (static_cast<int>(board.cohorts.size()) == board.cohort) {
      cohort = row.name;
      cohort_id = row.id;
    }
    board.cohorts.push_back(row.name);
  }
  std::vector<std::string> codes;
  for (const TraineeRow& trainee : TraineesOf(records))
    if (cohort_id.empty() || trainee.cohort == cohort_id) codes.push_back(trainee.code);
  board.rows =
      CohortRows(codes, state.document().scene.exercises, CohortStandings(records, cohort));
}

// The first group of this exercise whose metrics are of this version.
void SetBand(Records& records, const std::string& hash, const std::string& metric,
             const std::string& part, LearningCurve& curve) {
  for (const ReferenceGroup& group : ReferenceGroupsOf(records)) {
    if (group.exercise != hash || group.metrics_version != simulation::kMetricsVersion) continue;
    for (const ReferenceValueRow& row : group.values) {
      if (row.metric != metric || (!part.empty() && row.part != part) || !row.q1 || !row.q3)
        continue;
      curve.band = {*row.q1, *row.q3};
      curve.band_words = fmt::format("{}, n = {}", group.name, row.n);
      return;
    }
  }
}

void ReadCurve(Records& records, const EditorState& state, CohortBoard& board) {
  board.curve = {};
  board.metrics.clear();
  const Exercise* exercise = ChosenOf(state, board);
  if (exercise == nullptr || !HasChoice(board)) return;
  board.metrics.emplace_back("task_time", "both");
  for (const Criterion& criterion : exercise->criteria)
    if (const std::pair key(criterion.metric, criterion.part);
        criterion.metric != "task_time" && std::ranges::count(board.metrics, key) == 0)
      board.metrics.push_back(key);
  board.metric = std::clamp(board.metric, 0, static_cast<int>(board.metrics.size()) - 1);
  const auto& [metric, part] = board.metrics[static_cast<std::size_t>(board.metric)];
  const std::string hash = HashOf(*exercise);
  board.curve = CurveOf(ProgressOf(records, board.rows[static_cast<std::size_t>(board.row)].code,
                                   hash, metric, part));
  SetBand(records, hash, metric, part, board.curve);
}

// Reads the page anew; what the records refuse is its fault.
void Read(EditorState& state) {
  CohortBoard& board = BoardOf(state);
  LessonRecords& own = *state.steps.lessons->records;
  board.fault.clear();
  board.is_stale = false;
  board.document = state.document_number;
  if (own.place.empty()) {
    board.fault = "This window keeps no records.";
    return;
  }
  try {
    if (!ReachRecords(own)) {
      board.fault = own.fault;
      return;
    }
    const std::string chosen =
        HasChoice(board) ? board.rows[static_cast<std::size_t>(board.row)].code : "";
    ReadRows(*own.open, state, board);
    const auto row = std::ranges::find(board.rows, chosen, &CohortRowOfPage::code);
    board.row = row == board.rows.end() ? -1 : static_cast<int>(row - board.rows.begin());
    ReadCurve(*own.open, state, board);
  } catch (const Error& fault) {
    board.fault = fault.what();
  }
}

}  // namespace

std::vector<CohortRowOfPage> CohortRows(const std::vector<std::string>& codes,
                                        const std::vector<Exercise>& exercises,
                                        const std::vector<Standing>& standings) {
  std::map<std::string, std::vector<Standing>> by_code;
  for (const Standing& standing : standings) by_code[standing.trainee].push_back(standing);
  const std::vector<std::string> hashes = HashesOf(exercises);
  std::vector<CohortRowOfPage> rows;
  for (const std::string& code : codes) {
    CohortRowOfPage& row = rows.emplace_back();
    row.code = code;
    const auto board = StandingsFor(exercises, hashes, by_code[code], {});
    for (std::size_t i = 0; i < exercises.size(); ++i) {
      CohortCell& cell = row.cells.emplace_back();
      cell.tries = board[i].tries;
      cell.passes = board[i].passes;
      cell.last = board[i].last_outcome;
      cell.is_gate_passed = board[i].tries > 0 && board[i].gate.is_open;
      for (const Standing& standing : by_code[code])
        if (standing.exercise == hashes[i]) cell.is_gate_opened = standing.is_gate_opened;
    }
  }
  return rows;
}

std::string CusumAdvice(const std::vector<double>& cusum) {
  if (cusum.empty()) return "No attempt was finished yet.";
  double lowest = 0, highest = 0;
  for (const double sum : cusum) {
    lowest = std::min(lowest, sum);
    highest = std::max(highest, sum);
  }
  const double last = cusum.back();
  if (last >= simulation::CusumUpperLine())
    return "Advice: more failures than one in ten; look at an attempt together.";
  if (last <= simulation::CusumLowerLine())
    return "Advice: few enough failures for the level that is asked for.";
  if (highest >= simulation::CusumUpperLine())
    return "Advice: there were many failures, and it is getting better.";
  if (lowest <= simulation::CusumLowerLine())
    return "Advice: the level was reached, and failures have come back.";
  return "Advice: too few attempts to say more.";
}

LearningCurve CurveOf(std::vector<AttemptPoint> points) {
  LearningCurve curve;
  std::vector<std::optional<double>> values;
  double sum = 0;
  for (const AttemptPoint& point : points) {
    values.push_back(point.value);
    const bool is_pass = point.outcome == AttemptOutcome::kPassed;
    if (!is_pass && point.outcome != AttemptOutcome::kFailed) continue;
    curve.cusum.push_back(sum += is_pass ? simulation::CusumOfPass() : simulation::CusumOfFail());
  }
  curve.median = simulation::RunningMedian(values);
  curve.advice = CusumAdvice(curve.cusum);
  curve.points = std::move(points);
  return curve;
}

CohortBoard& FreshCohortBoard(EditorState& state) {
  CohortBoard& board = BoardOf(state);
  if (board.is_stale || board.document != state.document_number) Read(state);
  return board;
}

void ShowInstructorPage(EditorState& state) {
  BoardOf(state).is_stale = true;
  state.steps.lessons->page = LessonPage::kInstructor;
}

void ChooseCohort(EditorState& state, int cohort) {
  BoardOf(state).cohort = cohort;
  BoardOf(state).is_stale = true;
}

void ChooseCell(EditorState& state, int row, int exercise) {
  CohortBoard& board = BoardOf(state);
  board.row = row;
  board.exercise = exercise;
  board.metric = 0;
  board.is_stale = true;
}

void ChooseMetric(EditorState& state, int metric) {
  BoardOf(state).metric = metric;
  BoardOf(state).is_stale = true;
}

bool MayOpenGate(const EditorState& state) {
  const CohortBoard& board = *state.steps.lessons->cohort;
  return HasChoice(board) && ChosenOf(state, board) != nullptr && !board.who.empty() &&
         !board.reason.empty() && state.steps.lessons->records->open != nullptr;
}

void OpenChosenGate(EditorState& state) {
  CohortBoard& board = BoardOf(state);
  const Exercise& exercise = *ChosenOf(state, board);
  const std::string& code = board.rows[static_cast<std::size_t>(board.row)].code;
  OpenGate(*state.steps.lessons->records->open, code, ExerciseRowOf(exercise), board.who,
           board.reason);
  state.message =
      fmt::format("\"{}\" is open for {}; the audit keeps by whom and why.", exercise.title, code);
  board.reason.clear();
  board.is_stale = true;
  state.steps.lessons->start->is_stale = true;
}

void SaveAttemptTable(EditorState& state) {
  Browse(
      state, BrowseFor::kSaveFile, "Save the attempts as a table", "Save", {{"Tables", {".csv"}}},
      [](EditorState& now, const std::filesystem::path& file) {
        Guarded(now, "Table", [&] {
          LessonRecords& records = *now.steps.lessons->records;
          if (!ReachRecords(records)) throw Error(Code::kFile, records.fault);
          WriteAtomically(file, AttemptTable(ReadBundle(*records.open)), Access::kPrivate);
          now.message = "The table is in " + file.string() + ".";
        });
      },
      "attempts.csv");
}

}  // namespace arthro::app

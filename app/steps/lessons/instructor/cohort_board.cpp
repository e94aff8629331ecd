#include "app/steps/lessons/instructor/cohort_board.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <utility>

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

CohortBoard& CohortOf(EditorState& state) { return *state.steps.lessons->cohort; }

const Exercise* ChosenOf(const EditorState& state, const CohortBoard& board) {
  const auto& exercises = state.document().scene.exercises;
  return board.exercise >= 0 && board.exercise < static_cast<int>(exercises.size())
             ? &exercises[static_cast<std::size_t>(board.exercise)]
             : nullptr;
}

bool HasChoice(const CohortBoard& board) {
  return board.row >= 0 && board.row < static_cast<int>(board.rows.size());
}

bool HasPart(const std::string& text, const std::string& part) {
  const auto is_same = [](unsigned char a, unsigned char b) {
    return std::toupper(a) == std::toupper(b);
  };
  return part.empty() ||
         std::search(text.begin(), text.end(), part.begin(), part.end(), is_same) != text.end();
}

// The rows of the chosen cohort without their cells, which are read as they are shown.
void ReadRows(Records& records, CohortBoard& board) {
  board.cohorts.clear();
  board.rows.clear();
  std::string cohort_id;
  for (const CohortRow& row : CohortsOf(records)) {
    if (row.name == board.choice.cohort) cohort_id = row.id;
    board.cohorts.push_back(row.name);
  }
  if (cohort_id.empty()) board.choice.cohort.clear();  // it is no more
  for (const TraineeRow& trainee : TraineesOf(records))
    if ((cohort_id.empty() || trainee.cohort == cohort_id) && HasPart(trainee.code, board.search))
      board.rows.push_back({trainee.code, {}});
}

// Group whose band is drawn: the one that was chosen, or the first; empty: none.
std::string GroupOf(const CohortBoard& board) {
  if (!board.choice.has_band || board.groups.empty()) return "";
  if (board.choice.group.empty()) return board.groups.front();
  return std::ranges::count(board.groups, board.choice.group) > 0 ? board.choice.group : "";
}

void ReadBand(Records& records, const std::string& hash, const std::string& metric,
              const std::string& part, const std::string& rig, CohortBoard& board) {
  const auto groups = ReferenceGroupsAt(records, hash, simulation::kMetricsVersion, rig);
  board.groups.clear();
  for (const ReferenceGroup& group : groups) board.groups.push_back(group.name);
  const auto chosen = std::ranges::find(groups, GroupOf(board), &ReferenceGroup::name);
  if (chosen == groups.end()) return;
  for (const ReferenceValueRow& row : chosen->values) {
    if (row.metric != metric || (!part.empty() && row.part != part) || !row.q1 || !row.q3) continue;
    board.curve.band = {*row.q1, *row.q3};
    board.curve.band_words = fmt::format("{}, n = {}", chosen->name, row.n);
    return;
  }
}

void ReadCurve(Records& records, const EditorState& state, CohortBoard& board) {
  board.is_curve_stale = false;
  board.curve = {};
  board.metrics.clear();
  board.groups.clear();
  const Exercise* exercise = ChosenOf(state, board);
  if (exercise == nullptr || !HasChoice(board)) return;
  board.metrics.emplace_back("task_time", "both");
  for (const Criterion& criterion : exercise->criteria)
    if (const std::pair key(criterion.metric, criterion.part);
        criterion.metric != "task_time" && std::ranges::count(board.metrics, key) == 0)
      board.metrics.push_back(key);
  board.metric = std::clamp(board.metric, 0, static_cast<int>(board.metrics.size()) - 1);
  const auto& [metric, part] = board.metrics[static_cast<std::size_t>(board.metric)];
  const std::string& hash = board.hashes.at(static_cast<std::size_t>(board.exercise));
  const auto points = ProgressOf(records, board.rows[static_cast<std::size_t>(board.row)].code,
                                 hash, metric, part, board.performers);
  board.curve = CurveOf(points);
  // The band is of the rig with which the trainee made the last attempt.
  if (!points.empty()) ReadBand(records, hash, metric, part, points.back().rig, board);
}

// Runs `work` on the records; what they refuse is the page's fault.
template <class Work>
void WithRecords(EditorState& state, const Work& work) {
  CohortBoard& board = CohortOf(state);
  LessonRecords& own = *state.steps.lessons->records;
  try {
    if (ReachRecords(own))
      work(*own.open);
    else
      board.fault = own.place.empty() ? "This window keeps no records." : own.fault;
  } catch (const Error& fault) {
    board.fault = fault.what();
  }
}

// Reads the codes anew; a trainee that was chosen stays so.
void Read(EditorState& state) {
  CohortBoard& board = CohortOf(state);
  board.fault.clear();
  board.is_stale = false;
  board.is_curve_stale = true;
  board.document = state.document_number;
  board.hashes = HashesOf(state.document().scene.exercises);
  const LessonRecords& own = *state.steps.lessons->records;
  if (!own.place.empty() && !board.knows_choice) board.choice = ReadInstructorChoice(FolderOf(own));
  board.knows_choice = true;
  const std::string chosen =
      HasChoice(board) ? board.rows[static_cast<std::size_t>(board.row)].code : "";
  WithRecords(state, [&](Records& records) { ReadRows(records, board); });
  const auto row = std::ranges::find(board.rows, chosen, &CohortRowOfPage::code);
  board.row = row == board.rows.end() ? -1 : static_cast<int>(row - board.rows.begin());
}

void KeepChoice(EditorState& state) {
  const LessonRecords& records = *state.steps.lessons->records;
  if (!records.place.empty()) WriteInstructorChoice(FolderOf(records), CohortOf(state).choice);
}

}  // namespace

std::vector<CohortCell> CellsOf(const std::vector<Exercise>& exercises,
                                const std::vector<std::string>& hashes,
                                const std::vector<Standing>& standings) {
  const auto board = StandingsFor(exercises, hashes, standings, {});
  std::vector<CohortCell> cells(exercises.size());
  for (std::size_t i = 0; i < exercises.size(); ++i) {
    CohortCell& cell = cells[i];
    cell.tries = board[i].tries;
    cell.passes = board[i].passes;
    cell.last = board[i].last_outcome;
    cell.is_gate_passed = board[i].tries > 0 && board[i].gate.is_open;
    for (const Standing& standing : standings)
      if (standing.exercise == hashes[i]) cell.is_gate_opened = standing.is_gate_opened;
  }
  return cells;
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
  CohortBoard& board = CohortOf(state);
  if (board.is_stale || board.document != state.document_number ||
      board.hashes.size() != state.document().scene.exercises.size())
    Read(state);
  if (board.is_curve_stale)
    WithRecords(state, [&](Records& records) { ReadCurve(records, state, board); });
  board.is_curve_stale = false;  // nor is it asked for again where the records refuse it
  return board;
}

void ReadShownRows(EditorState& state, int first, int last) {
  CohortBoard& board = CohortOf(state);
  const auto& exercises = state.document().scene.exercises;
  if (exercises.empty()) return;
  // Rows read beyond those shown on each side, so that a slow scroll asks once in a while.
  constexpr int kMore = 16;
  const auto is_unread = [](const CohortRowOfPage& row) { return row.cells.empty(); };
  const auto begin = board.rows.begin();
  last = std::min(last, static_cast<int>(board.rows.size()));
  if (first >= last || std::none_of(begin + first, begin + last, is_unread)) return;
  const int end = std::min(last + kMore, static_cast<int>(board.rows.size()));
  std::vector<std::string> codes;
  for (int row = std::max(0, first - kMore); row < end; ++row)
    if (is_unread(begin[row])) codes.push_back(begin[row].code);
  std::map<std::string, std::vector<Standing>> by_code;
  WithRecords(state, [&](Records& records) {
    for (Standing& standing : StandingsOf(records, codes, board.performers))
      by_code[standing.trainee].push_back(std::move(standing));
  });
  for (const std::string& code : codes)
    std::ranges::find(board.rows, code, &CohortRowOfPage::code)->cells =
        CellsOf(exercises, board.hashes, by_code[code]);
}

void ShowInstructorPage(EditorState& state) {
  CohortOf(state).is_stale = true;
  state.steps.lessons->page = LessonPage::kInstructor;
}

void ChooseCohort(EditorState& state, const std::string& cohort) {
  CohortOf(state).choice.cohort = cohort;
  CohortOf(state).is_stale = true;
  KeepChoice(state);
}

void FindTrainees(EditorState& state, const std::string& part_of_code) {
  CohortOf(state).search = part_of_code;
  CohortOf(state).is_stale = true;
}

void ShowAttemptsOf(EditorState& state, Performers performers) {
  CohortOf(state).performers = performers;
  CohortOf(state).is_stale = true;
}

void ChooseCell(EditorState& state, int row, int exercise) {
  CohortBoard& board = CohortOf(state);
  board.row = row;
  board.exercise = exercise;
  board.metric = 0;
  board.is_curve_stale = true;
}

void ChooseMetric(EditorState& state, int metric) {
  CohortOf(state).metric = metric;
  CohortOf(state).is_curve_stale = true;
}

void ChooseGroup(EditorState& state, const std::string& group) {
  CohortBoard& board = CohortOf(state);
  board.choice.has_band = !group.empty();
  if (!group.empty()) board.choice.group = group;
  board.is_curve_stale = true;
  KeepChoice(state);
}

bool MayOpenGate(const EditorState& state) {
  const CohortBoard& board = *state.steps.lessons->cohort;
  return HasChoice(board) && ChosenOf(state, board) != nullptr && !board.who.empty() &&
         !board.reason.empty() && state.steps.lessons->records->open != nullptr;
}

void OpenChosenGate(EditorState& state) {
  CohortBoard& board = CohortOf(state);
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

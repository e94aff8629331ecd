#include "app/steps/lessons/trainee.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "app/steps/lessons/keeping/lesson_records.h"
#include "simulation/core/error.h"
#include "simulation/scene/exercise/find_exercise.h"
#include "simulation/scene/json/exercise_json.h"

namespace arthro::app {
namespace {

StartBoard& StartOf(EditorState& state) { return *state.steps.lessons->start; }

// Runs `work`; what the records refuse is the page's fault.
template <class Work>
void Try(EditorState& state, const Work& work) {
  StartBoard& board = StartOf(state);
  board.fault.clear();
  try {
    work();
  } catch (const Error& fault) {
    board.fault = fault.what();
  }
  board.is_stale = true;
}

void ReadRows(EditorState& state, StartBoard& board) {
  LessonRecords& records = *state.steps.lessons->records;
  const auto& exercises = state.document().scene.exercises;
  std::vector<Standing> standings;
  std::vector<GateRow> opened;
  board.attempts.clear();
  if (!records.trainee.empty() && ReachRecords(records)) {
    standings = StandingsOf(*records.open, records.trainee);
    opened = GatesOf(*records.open, records.trainee);
    if (const Exercise* chosen = ChosenExercise(state))
      board.attempts = AttemptsOf(*records.open, records.trainee, HashOf(*chosen));
    std::reverse(board.attempts.begin(), board.attempts.end());
  }
  board.rows = StandingsFor(exercises, HashesOf(exercises), standings, opened);
}

}  // namespace

void TakeTraineeCode(EditorState& state, const std::string& code) {
  Try(state, [&] {
    LessonRecords& records = *state.steps.lessons->records;
    StartOf(state).unknown = ChooseTrainee(records, code) ? "" : code;
    if (records.trainee == code) state.message = "Trainee " + code + ".";
  });
}

void AddTraineeCode(EditorState& state) {
  Try(state, [&] {
    StartBoard& board = StartOf(state);
    AddAndChooseTrainee(*state.steps.lessons->records, board.unknown);
    state.message = "Trainee " + std::exchange(board.unknown, "") + " was added.";
  });
}

void SuggestTraineeCode(EditorState& state) {
  Try(state, [&] {
    LessonRecords& records = *state.steps.lessons->records;
    StartBoard& board = StartOf(state);
    if (ReachRecords(records)) board.code = board.unknown = FreeCode(*records.open);
  });
}

void ChangeTrainee(EditorState& state) {
  LeaveTrainee(*state.steps.lessons->records);
  StartBoard& board = StartOf(state);
  board.code.clear();
  board.unknown.clear();
  board.is_stale = true;
}

void StartExercise(EditorState& state, int exercise) {
  LessonsStep& step = *state.steps.lessons;
  step.chosen = exercise;
  const LessonRecords& records = *step.records;
  const std::string code = StartOf(state).code;
  if (records.trainee.empty() && !records.place.empty() && !code.empty()) {
    TakeTraineeCode(state, code);
    if (records.trainee.empty()) {
      if (StartOf(state).fault.empty())
        state.message = "Add this trainee, or clear the code to practise without a record.";
      return;
    }
  }
  step.page = LessonPage::kBriefing;
}

const StartBoard& FreshStartBoard(EditorState& state) {
  StartBoard& board = StartOf(state);
  const int chosen = state.steps.lessons->chosen;
  const bool is_other = board.attempts_of != chosen || board.document != state.document_number ||
                        board.rows.size() != state.document().scene.exercises.size();
  if (!board.is_stale && !is_other) return board;
  board.attempts_of = chosen;
  board.document = state.document_number;
  try {
    ReadRows(state, board);
  } catch (const Error& fault) {
    board.fault = fault.what();
  }
  board.is_stale = false;
  return board;
}

void OpenBriefing(EditorState& state, const std::string& exercise, const std::string& trainee,
                  bool is_test) {
  LessonsStep& step = *state.steps.lessons;
  const auto& exercises = state.document().scene.exercises;
  step.chosen = static_cast<int>(&ExerciseWithId(exercises, exercise) - exercises.data());
  step.is_test = is_test;
  step.page = LessonPage::kBriefing;
  if (!trainee.empty()) TakeTraineeCode(state, trainee);
  if (!FreshStartBoard(state).unknown.empty()) step.page = LessonPage::kStart;
}

std::string WhyShut(const EditorState& state) {
  const LessonsStep& step = *state.steps.lessons;
  const auto chosen = static_cast<std::size_t>(step.chosen);
  if (step.records->trainee.empty() || step.chosen < 0 || chosen >= step.start->rows.size() ||
      step.start->rows[chosen].is_open)
    return "";
  return fmt::format("Shut for {}: pass \"{}\" first, or let an instructor open it.",
                     step.records->trainee, step.start->rows[chosen].needed);
}

}  // namespace arthro::app

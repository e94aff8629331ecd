// Lessons: begin an exercise, act in its attempt, look back, and edit the exercises of the scene.
#include <algorithm>
#include <utility>

#include <GLFW/glfw3.h>

#include "app/state/edits.h"
#include "app/steps/lessons/attempt.h"
#include "app/steps/lessons/exercise_edit.h"
#include "app/steps/lessons/keeping/lesson_records.h"
#include "app/steps/lessons/keeping/start_board.h"
#include "app/steps/lessons/running_attempt.h"
#include "app/steps/practice/start_practice.h"

namespace arthro::app {
namespace {

using State = EditorState;
using simulation::ActKind;

bool RunsAttempt(const State& state) { return state.steps.lessons->running.has_value(); }
bool HasHint(const State& state) {
  if (!RunsAttempt(state)) return false;
  const simulation::StepEngine& engine = state.steps.lessons->running->engine;
  return std::ranges::any_of(engine.strip().open, [&](const simulation::OpenStep& open) {
    return BaseOf(engine.exercise().steps[static_cast<std::size_t>(open.step)]).cue !=
           CueKind::kNone;
  });
}
bool HasNote(const State& state) {
  return RunsAttempt(state) && !state.steps.lessons->note.empty();
}
void KeepNote(State& state) {
  Act(state, {ActKind::kNote, 0, std::exchange(state.steps.lessons->note, {})});
  state.message = "The remark was noted in the attempt.";
}
void TogglePause(State& state) {
  PauseAttempt(state, !IsPaused(state));
  state.message =
      IsPaused(state) ? "The attempt is paused: its time stands still." : "The attempt goes on.";
}
void Repeat(State& state) {
  const auto& finished = state.steps.lessons->finished;
  finished && finished->is_unscored ? BeginUnscored(state) : BeginExercise(state);
}
bool HasResult(const State& state) {
  return !state.practice && state.steps.lessons->finished.has_value();
}
bool HasReport(const State& state) {
  return HasResult(state) && !IsBlinded(state) && !state.steps.lessons->finished->is_unscored;
}
bool ShowsWhose(const State& state) { return HasResult(state) && !IsBlinded(state); }
bool HasFrames(const State& state) {
  return HasResult(state) && !state.steps.lessons->finished->frames.empty();
}

template <ActKind kind>
void Do(State& state) {
  Act(state, {kind, 0, ""});
}

bool ShowsLesson(const State& state) {
  return !state.practice && state.steps.lessons->page != LessonPage::kNone;
}

// Behind the pages of the practise job there is no editor.
void Close(State& state) {
  if (state.practice_only)
    state.quit = true;
  else
    state.steps.lessons->page = LessonPage::kNone;
}

constexpr Command kLessonCommands[] = {
    {"exercise-briefing",
     "Start exercise…",
     "Read what the chosen exercise asks for, then begin it.",
     "Lessons",
     {},
     {},
     [](const State& state) { return ChosenExercise(state) != nullptr && MayPractise(state); },
     [](State& state) { state.steps.lessons->page = LessonPage::kBriefing; },
     "First choose an exercise of this scene."},
    {"trainee-page",
     "Trainee's page",
     "Show the exercises of this scene with the results and gates of a trainee.",
     "Lessons",
     {GLFW_KEY_F6, true},
     {},
     [](const State& state) { return InEditor(state) || ShowsLesson(state); },
     [](State& state) {
       state.steps.lessons->start->is_stale = true;
       state.steps.lessons->page = LessonPage::kStart;
     }},
    {"instructor-page",
     "Instructor's page",
     "Show all trainees of the records: attempts, gates, learning curves.",
     "Lessons",
     {GLFW_KEY_F7, true},
     {},
     [](const State& state) { return InEditor(state) || ShowsLesson(state); },
     ShowInstructorPage},
    {"open-gate",
     "Open the gate",
     "Open the chosen exercise for the chosen trainee; the audit keeps by whom and why.",
     "Lessons",
     {},
     {},
     MayOpenGate,
     OpenChosenGate,
     "First choose a trainee and an exercise, and give your code and a reason."},
    {"rate-attempt",
     "Rate…",
     "Fill in a rating form beside the look back.",
     "Lessons",
     {},
     {},
     [](const State& state) { return MayRate(state) && !IsBlinded(state); },
     ToggleRating,
     "Only an attempt of the records can be rated, while one looks back at it."},
    {"rate-blinded",
     "Rate blinded…",
     "Rate an attempt at the chosen exercise without its trainee, date, result and ratings.",
     "Lessons",
     {},
     {},
     MayRateBlinded,
     RateBlinded,
     "First choose an exercise of the instructor's page."},
    {"keep-rating",
     "Keep this rating",
     "Write the rating with the attempt into the records.",
     "Lessons",
     {},
     {},
     MayKeepRating,
     KeepRating,
     "First give the rater's name, and a score of one item or more."},
    {"attempt-table",
     "Save table…",
     "Write every attempt of the records as a table (CSV).",
     "Lessons",
     {},
     {},
     [](const State& state) { return state.steps.lessons->records->open != nullptr; },
     SaveAttemptTable,
     "The records are not open."},
    {"open-attempt",
     "Open attempt…",
     "Look back at an attempt of another station, or at recorded hands, from a file.",
     "Lessons",
     {},
     {},
     MayOpenAttempt,
     BrowseForAttempt,
     "This scene has no exercises, or other work is under way."},
    {"repeat-exercise",
     "Again",
     "Begin another attempt at the same exercise.",
     "Lessons",
     {},
     {},
     MayBeginExercise,
     Repeat,
     "This exercise cannot be begun now."},
    {"begin-unscored",
     "Unscored",
     "Try the exercise with any lens and instrument; nothing is scored or kept.",
     "Lessons",
     {},
     {},
     MayBeginExercise,
     BeginUnscored,
     "This exercise cannot be begun now."},
    {"keep-attempt",
     "Keep attempt",
     "Try again to write the attempt, which neither the records nor the outbox took.",
     "Lessons",
     {},
     {},
     HasUnkeptAttempt,
     KeepAttempt,
     "The last attempt is kept already."},
    {"begin-exercise",
     "Begin",
     "Begin an attempt at the chosen exercise.",
     "Lessons",
     {},
     {},
     MayBeginExercise,
     BeginExercise,
     "This exercise cannot be begun now."},
    {"attempt-hint",
     "Hint",
     "Show where the target is, where the step has a hint.",
     "Lessons",
     {GLFW_KEY_N},
     {},
     HasHint,
     Do<ActKind::kHint>,
     "This step has no hint."},
    {"attempt-mark",
     "Mark",
     "Mark the place under the instrument's tip, for a measurement.",
     "Lessons",
     {GLFW_KEY_M},
     {},
     RunsAttempt,
     Do<ActKind::kMark>,
     "No attempt is under way."},
    {"attempt-pause",
     "Pause",
     "Stop the time of the attempt, or let it go on; nothing counts meanwhile.",
     "Lessons",
     {GLFW_KEY_I},
     {},
     RunsAttempt,
     TogglePause,
     "No attempt is under way."},
    {"attempt-note",
     "Note",
     "Write the remark into the events of the attempt (for the instructor).",
     "Lessons",
     {},
     {},
     HasNote,
     KeepNote,
     "First type a remark."},
    {"attempt-look-down",
     "Looks down",
     "Note that the trainee looked at the hands (for the instructor).",
     "Lessons",
     {GLFW_KEY_L},
     {},
     RunsAttempt,
     Do<ActKind::kLookDown>,
     "No attempt is under way."},
    {"end-attempt",
     "End attempt",
     "End the attempt, as Esc does; what was observed is kept.",
     "Lessons",
     {},
     {},
     RunsAttempt,
     StopAttempt,
     "No attempt is under way."},
    {"attempt-debrief",
     "Look back",
     "Look at the attempt again: picture, steps, force and path.",
     "Lessons",
     {},
     {},
     HasFrames,
     OpenDebrief,
     "No pictures of an attempt were kept."},
    {"use-as-expert",
     "Use as expert's",
     "Keep this passed attempt in the scene, beside which trainees see their own.",
     "Lessons",
     {},
     {},
     MayBeExpert,
     UseAsExpert,
     "Only an attempt of this scene that was passed can be the expert's."},
    {"attempt-summary",
     "Result",
     "Show the criteria and whether each was met.",
     "Lessons",
     {},
     {},
     ShowsWhose,
     [](State& state) { state.steps.lessons->page = LessonPage::kSummary; },
     "There is no attempt, or it is being rated blinded."},
    {"attempt-report",
     "Save report…",
     "Write a page (HTML) with steps, criteria, plots and metrics of this attempt, for print.",
     "Lessons",
     {},
     {},
     HasReport,
     SaveReport,
     "There is no scored attempt, or it is being rated blinded."},
    {"debrief-play",
     "Play",
     "Play or stop the look back.",
     "Lessons",
     {},
     {},
     HasFrames,
     [](State& state) {
       Debrief& debrief = state.steps.lessons->debrief;
       debrief.plays = !debrief.plays;
     },
     "No pictures of an attempt were kept."},
    {"close-lesson",
     "Close",
     "Leave the pages of exercises.",
     "Lessons",
     {},
     {},
     ShowsLesson,
     Close,
     "No page of exercises is open."},
    {"new-exercise",
     "New exercise",
     "Add an exercise to this scene.",
     "Lessons",
     {},
     {},
     InEditor,
     AddExercise},
    {"copy-exercise",
     "Copy",
     "Copy the chosen exercise.",
     "Lessons",
     {},
     {},
     HasExercise,
     CopyExercise,
     "First choose an exercise."},
    {"remove-exercise",
     "Remove",
     "Remove the chosen exercise.",
     "Lessons",
     {},
     {},
     HasExercise,
     RemoveExercise,
     "First choose an exercise."},
    {"check-targets",
     "Check that targets can be seen",
     "Look for a pose of the scope that sees each target of the steps.",
     "Lessons",
     {},
     {},
     MayCheckTargets,
     CheckTargets,
     "First add a step, and wait until no other work is under way."},
};

}  // namespace

std::span<const Command> LessonCommands() { return kLessonCommands; }

}  // namespace arthro::app

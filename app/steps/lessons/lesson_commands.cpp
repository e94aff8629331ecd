// Lessons: begin an exercise, act in its attempt, look back, and edit the exercises of the scene.
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
  const int step = engine.strip().step;
  return step >= 0 &&
         BaseOf(engine.exercise().steps[static_cast<std::size_t>(step)]).cue != CueKind::kNone;
}
bool HasResult(const State& state) {
  return !state.practice && state.steps.lessons->finished.has_value();
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

constexpr Command kCommands[] = {
    {"exercise-briefing",
     "Start exercise…",
     "Read what the chosen exercise asks for, then begin it.",
     "Lessons",
     {},
     {},
     [](const State& state) { return ChosenExercise(state) != nullptr && MayPractise(state); },
     [](State& state) { state.steps.lessons->page = LessonPage::kBriefing; }},
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
     OpenChosenGate},
    {"rate-attempt",
     "Rate…",
     "Fill in a rating form beside the look back.",
     "Lessons",
     {},
     {},
     [](const State& state) { return MayRate(state) && !IsBlinded(state); },
     ToggleRating},
    {"rate-blinded",
     "Rate blinded…",
     "Rate an attempt at the chosen exercise without its trainee, date, result and ratings.",
     "Lessons",
     {},
     {},
     MayRateBlinded,
     RateBlinded},
    {"keep-rating",
     "Keep this rating",
     "Write the rating with the attempt into the records.",
     "Lessons",
     {},
     {},
     MayKeepRating,
     KeepRating},
    {"attempt-table",
     "Save table…",
     "Write every attempt of the records as a table (CSV).",
     "Lessons",
     {},
     {},
     [](const State& state) { return state.steps.lessons->records->open != nullptr; },
     SaveAttemptTable},
    {"repeat-exercise",
     "Again",
     "Begin another attempt at the same exercise.",
     "Lessons",
     {},
     {},
     MayBeginExercise,
     BeginExercise},
    {"keep-attempt",
     "Keep attempt",
     "Try again to write the attempt, which neither the records nor the outbox took.",
     "Lessons",
     {},
     {},
     HasUnkeptAttempt,
     KeepAttempt},
    {"begin-exercise",
     "Begin",
     "Begin an attempt at the chosen exercise.",
     "Lessons",
     {},
     {},
     MayBeginExercise,
     BeginExercise},
    {"attempt-hint",
     "Hint",
     "Show where the target is, where the step has a hint.",
     "Lessons",
     {GLFW_KEY_N},
     {},
     HasHint,
     Do<ActKind::kHint>},
    {"attempt-mark",
     "Mark",
     "Mark the place under the instrument's tip, for a measurement.",
     "Lessons",
     {GLFW_KEY_M},
     {},
     RunsAttempt,
     Do<ActKind::kMark>},
    {"attempt-look-down",
     "Looks down",
     "Note that the trainee looked at the hands (for the instructor).",
     "Lessons",
     {GLFW_KEY_L},
     {},
     RunsAttempt,
     Do<ActKind::kLookDown>},
    {"end-attempt",
     "End attempt",
     "End the attempt, as Esc does; what was observed is kept.",
     "Lessons",
     {},
     {},
     RunsAttempt,
     StopAttempt},
    {"attempt-debrief",
     "Look back",
     "Look at the attempt again: picture, steps, force and path.",
     "Lessons",
     {},
     {},
     HasFrames,
     OpenDebrief},
    {"use-as-expert",
     "Use as expert's",
     "Keep this passed attempt in the scene, beside which trainees see their own.",
     "Lessons",
     {},
     {},
     MayBeExpert,
     UseAsExpert},
    {"attempt-summary",
     "Result",
     "Show the criteria and whether each was met.",
     "Lessons",
     {},
     {},
     ShowsWhose,
     [](State& state) { state.steps.lessons->page = LessonPage::kSummary; }},
    {"attempt-report",
     "Save report…",
     "Write a page (HTML) with steps, criteria, plots and metrics of this attempt, for print.",
     "Lessons",
     {},
     {},
     ShowsWhose,
     SaveReport},
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
     }},
    {"close-lesson",
     "Close",
     "Leave the pages of exercises.",
     "Lessons",
     {},
     {},
     ShowsLesson,
     Close},
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
     CopyExercise},
    {"remove-exercise",
     "Remove",
     "Remove the chosen exercise.",
     "Lessons",
     {},
     {},
     HasExercise,
     RemoveExercise},
};

}  // namespace

std::span<const Command> LessonCommands() { return kCommands; }

}  // namespace arthro::app

// An attempt at an exercise in the window: its begin, its frames, and its end.
#pragma once

#include "app/steps/lessons/lessons_step.h"
#include "simulation/training/steps/trainee_act.h"

namespace arthro::app {

// True where the exercise that is chosen can be begun.
bool MayBeginExercise(const EditorState& state);
// Starts a practice in the exercise's state, with an attempt that begins with its first frame.
void BeginExercise(EditorState& state);
// The same without a score: any lens and instrument, no criteria, and nothing is kept.
void BeginUnscored(EditorState& state);
// Stops the time of the attempt that runs, or lets it go on. Frames of a pause count for nothing.
void PauseAttempt(EditorState& state, bool is_paused);
void Act(EditorState& state, const simulation::TraineeAct& act);
// Ends the attempt as one that was stopped, and its practice.
void StopAttempt(EditorState& state);
// Tries again to keep an attempt that neither the records nor the outbox took.
bool HasUnkeptAttempt(const EditorState& state);
void KeepAttempt(EditorState& state);

}  // namespace arthro::app

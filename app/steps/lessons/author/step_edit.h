// Edits of the steps of the chosen exercise.
#pragma once

#include <string>
#include <vector>

#include "app/steps/lessons/exercise_edit.h"

namespace arthro::app {

// Adds a step of a kind, an index of ExerciseStep, with the targets of the exercise that suit it.
void AddStep(EditorState& state, int kind);
void RemoveStep(EditorState& state, int step);
// Exchanges a step with the one before or after it.
void MoveStep(EditorState& state, int step, int by);
// Sets how the step shows its targets when the trainee asks, and after 20 s or its own time.
void SetCue(EditorState& state, int step, CueKind cue);

// True where a list of a step may name the target. Keys of lists: "targets", "path", "bodies",
// "regions", "to", "source".
bool TakesInto(const std::string& key, const ExerciseTarget& target);
// True where the kind of step reads the list.
bool UsesTargets(const ExerciseStep& step);

// Name on the page of a field of a step, by its key in the file.
std::string WordsOfStepField(const std::string& key);

// Sentences about what the step at this index of the chosen exercise lacks; empty: nothing.
std::vector<std::string> LacksOfStep(const EditorState& state, std::size_t step);
// The same of the chosen exercise as a whole, its steps named by their numbers.
std::vector<std::string> LacksOfExercise(const EditorState& state);

}  // namespace arthro::app

// Edits of the exercises of the scene; each is one step of the history. Those of targets and steps
// are in author/.
#pragma once

#include <functional>
#include <span>
#include <string>

#include "app/steps/lessons/lessons_step.h"

namespace arthro::app {

bool HasExercise(const EditorState& state);
// Begins with the view of the author.
void AddExercise(EditorState& state);
void BeginWithThisView(EditorState& state);
void CopyExercise(EditorState& state);
void RemoveExercise(EditorState& state);

// Changes the chosen exercise, and raises its version once per step of the history. Edits in a row
// with one `merge_key` are one step until EndDrag; a change of nothing makes none.
void EditExercise(EditorState& state, const std::string& name, const std::string& merge_key,
                  const std::function<void(Exercise&)>& change);

// "name-1", "name-2" … that is not taken.
std::string FreeName(std::span<const std::string> taken, const std::string& name);

void AddCriterion(EditorState& state);
// A criterion of this metric with limits to begin with: in the tool that is asked for most.
Criterion StartCriterion(const std::string& metric);

}  // namespace arthro::app

// Edits of the exercises of the scene; each is one step of the history.
#pragma once

#include <functional>
#include <string>

#include "app/steps/lessons/lessons_step.h"
#include "authoring/alignment/scene_point.h"

namespace arthro::app {

bool HasExercise(const EditorState& state);
// Begins with the view of the author.
void AddExercise(EditorState& state);
void BeginWithThisView(EditorState& state);
void CopyExercise(EditorState& state);
void RemoveExercise(EditorState& state);

// Changes the chosen exercise. Edits in a row with one `merge_key` are one step.
void EditExercise(EditorState& state, const std::string& name, const std::string& merge_key,
                  const std::function<void(Exercise&)>& change);

void AddTarget(EditorState& state);
void RemoveTarget(EditorState& state, int target);
// Names a target anew, wherever the exercise speaks of it; a name that another one has is refused
// with a message.
void RenameTarget(EditorState& state, int target, const std::string& name);
void AddStep(EditorState& state, int kind);
void RemoveStep(EditorState& state, int step);
// Whether the step shows its targets when the trainee asks, and after 20 s or its own time.
void SetHint(EditorState& state, int step, bool has_hint);
// Exchanges a step with the one before or after it.
void MoveStep(EditorState& state, int step, int by);
void AddCriterion(EditorState& state);
// A criterion of this metric with limits to begin with: in the tool that is asked for most.
Criterion StartCriterion(const std::string& metric);
// Point of a tissue on a line of sight.
struct TissueHit {
  int tissue = 0;
  glm::dvec3 x_in_tissue{0.0};
};
// True while a click in the scope's picture places the chosen target.
bool TakesTarget(const EditorState& state);
// Lays the chosen target where the line meets the tissue or the relief, whichever is nearer.
void PlaceTarget(EditorState& state, const authoring::Sight& sight,
                 const std::optional<TissueHit>& hit);

}  // namespace arthro::app

// Edits of the targets of the chosen exercise: their kinds, names and places.
#pragma once

#include <optional>
#include <string>

#include <glm/vec3.hpp>

#include "app/steps/lessons/exercise_edit.h"
#include "authoring/alignment/scene_point.h"

namespace arthro::app {

// Ways to give the place of a target. A point lies on a tissue or on the relief, whatever the click
// meets.
enum class TargetPlacing { kSurface, kBall, kRegions };
TargetPlacing PlacingOf(const ExerciseTarget& target);

// Adds a target that waits for a click.
void AddTarget(EditorState& state);
// Places the target in another way, beginning where it lies. Refused with a message where the scene
// has no region of a tissue.
void SetTargetPlacing(EditorState& state, int target, TargetPlacing placing);
// Takes it from all lists, too. Refused with a message where a step cannot do without it: the goal
// of bodies, and a bleeding.
void RemoveTarget(EditorState& state, int target);
// Names a target anew, wherever the exercise speaks of it; a name that another one has is refused
// with a message.
void RenameTarget(EditorState& state, int target, const std::string& name);

// Point of a tissue on a line of sight.
struct TissueHit {
  int tissue = 0;
  glm::dvec3 x_in_tissue{0.0};
};
// True while a click in a picture places the chosen target.
bool TakesTarget(const EditorState& state);
// Lays the chosen target where the line meets the tissue or the relief, whichever is nearer.
void PlaceTarget(EditorState& state, const authoring::Sight& sight,
                 const std::optional<TissueHit>& hit);

}  // namespace arthro::app

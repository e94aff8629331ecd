// Targets that a suggested incision spacing shall suit: the relief, tissues, and the targets of
// exercises. Chosen by name, so that they outlast other edits of the scene.
#pragma once

#include <string>
#include <vector>

#include "simulation/practice/reach/portal_reach.h"

namespace arthro::app {

struct EditorState;  // app/state/editor_state.h

struct SpacingTarget {
  enum class Kind { kRelief, kTissue, kExercise } kind = Kind::kRelief;
  std::string exercise;  // id, of a target of an exercise
  std::string name;      // name of the tissue, or id of the target
  friend bool operator==(const SpacingTarget&, const SpacingTarget&) = default;
};
std::string WordsOf(const SpacingTarget& target);  // "relief", "meniscus", "diagnostic: notch"

// Every one that the scene offers: the relief, then tissues, then targets of exercises.
std::vector<SpacingTarget> EverySpacingTarget(const Scene& scene);
// Those of these words. Throws Error(kBadArgument) with every word for one that is not there.
std::vector<SpacingTarget> SpacingTargetsOf(const Scene& scene,
                                            const std::vector<std::string>& words);
// The chosen ones that there still are. Without one: the tissue that is chosen, else the first one,
// else the relief.
std::vector<SpacingTarget> ChosenSpacingTargets(const EditorState& state);
bool IsChosen(const EditorState& state, const SpacingTarget& target);
// Adds it to the chosen ones, or takes it away. The last one stays.
void ToggleSpacingTarget(EditorState& state, const SpacingTarget& target);

// The targets as the search takes them, with the places of those of exercises, portal frame, m.
struct PlacedTargets {
  simulation::ReachTargets targets;
  std::vector<glm::dvec3> points;
};
// Throws Error(kBadScene) for a target that lies on nothing. Takes a tenth of a second for targets
// of exercises.
PlacedTargets PlaceTargets(const LoadedScene& loaded, const std::vector<SpacingTarget>& targets);

}  // namespace arthro::app

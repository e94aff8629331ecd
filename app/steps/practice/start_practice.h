// Starts a practice of the scene as it stands, on the mounts of the devices that hold the hands.
#pragma once

#include <functional>
#include <vector>

#include "app/steps/practice/practice_step.h"

namespace arthro::app {

bool MayPractise(const EditorState& state);
// Runs as a job; `then` is called once the practice is there. Needs MayPractise.
void StartPractice(EditorState& state, std::function<void(EditorState&)> then = {});

// Builds the depth field, the tissues' trees and their elements, which takes a moment: call it in a
// job. Throws Error where the scene cannot be practised: no panorama, or a material that is not
// among the presets. With TissuePace::kInline the same input gives the same pictures.
simulation::Practice MakePractice(const authoring::Document& document,
                                  const std::vector<simulation::TissuePreset>& presets,
                                  simulation::TissuePace pace);

}  // namespace arthro::app

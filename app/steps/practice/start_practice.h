// Starts a practice of the scene as it stands, on the mounts of the devices that hold the hands.
#pragma once

#include <functional>

#include "app/steps/practice/practice_step.h"

namespace arthro::app {

bool MayPractise(const EditorState& state);
// Runs as a job; `then` is called once the practice is there. Needs MayPractise.
void StartPractice(EditorState& state, std::function<void(EditorState&)> then = {});

}  // namespace arthro::app

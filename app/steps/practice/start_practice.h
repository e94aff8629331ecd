// Begins a practice in the scene as it stands, on the mounts of what holds the hands.
#pragma once

#include <functional>

#include "app/steps/practice/practice_step.h"

namespace arthro::app {

bool MayPractise(const EditorState& state);
// In a job; `then` is called once the practice is there. Only where MayPractise.
void StartPractice(EditorState& state, std::function<void(EditorState&)> then = {});

}  // namespace arthro::app

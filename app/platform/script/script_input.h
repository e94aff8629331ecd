// Clicks, drags, keys and typed text as events of the input queue.
#pragma once

#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "app/platform/input_queue.h"

namespace arthro::app {

// Position of the pointer.
void PushClick(int button, InputQueue& input);
// Pressed at `from`, moved along `way`, released at its end; window coordinates.
void PushDrag(int button, const glm::dvec2& from, const std::vector<glm::dvec2>& way,
              InputQueue& input);
// GLFW_KEY_… codes, modifiers first; released in the opposite order.
void PushKeys(const std::vector<int>& keys, bool down, InputQueue& input);
void PushText(const std::string& text, InputQueue& input);
// Into the slider or field under the pointer, instead of what it holds, and Enter.
void PushTyped(const std::string& text, InputQueue& input);

}  // namespace arthro::app

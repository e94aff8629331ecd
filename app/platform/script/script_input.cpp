#include "app/platform/script/script_input.h"

#include <GLFW/glfw3.h>

namespace arthro::app {
namespace {

// UTF-8 to code points; a malformed byte becomes U+FFFD.
std::u32string CodePoints(const std::string& text) {
  std::u32string points;
  for (std::size_t i = 0; i < text.size();) {
    const auto lead = static_cast<unsigned char>(text[i]);
    const int length = lead < 0x80         ? 1
                       : (lead >> 5) == 6  ? 2
                       : (lead >> 4) == 14 ? 3
                       : (lead >> 3) == 30 ? 4
                                           : 0;
    if (length == 0 || i + static_cast<std::size_t>(length) > text.size()) {
      points += U'\uFFFD';
      ++i;
      continue;
    }
    char32_t point = length == 1 ? lead : lead & (0x7F >> length);
    for (int k = 1; k < length; ++k)
      point =
          (point << 6) | (static_cast<unsigned char>(text[i + static_cast<std::size_t>(k)]) & 0x3F);
    points += point;
    i += static_cast<std::size_t>(length);
  }
  return points;
}

}  // namespace

void PushClick(int button, InputQueue& input) {
  input.Push(ButtonChanged{button, true});
  input.Push(ButtonChanged{button, false});
}

void PushDrag(int button, const glm::dvec2& from, const std::vector<glm::dvec2>& way,
              InputQueue& input) {
  input.Push(PointerMoved{from.x, from.y});
  input.Push(ButtonChanged{button, true});
  for (const glm::dvec2& at : way) input.Push(PointerMoved{at.x, at.y});
  input.Push(ButtonChanged{button, false});
}

void PushKeys(const std::vector<int>& keys, bool down, InputQueue& input) {
  if (down)
    for (const int key : keys) input.Push(KeyChanged{key, true});
  else
    for (auto key = keys.rbegin(); key != keys.rend(); ++key) input.Push(KeyChanged{*key, false});
}

void PushText(const std::string& text, InputQueue& input) {
  for (const char32_t point : CodePoints(text)) input.Push(CharacterTyped{point});
}

// A slider becomes a text field on Ctrl+click, its text selected.
void PushTyped(const std::string& text, InputQueue& input) {
  input.Push(KeyChanged{GLFW_KEY_LEFT_CONTROL, true});
  PushClick(0, input);
  PushKeys({GLFW_KEY_A}, true, input);
  PushKeys({GLFW_KEY_A}, false, input);
  input.Push(KeyChanged{GLFW_KEY_LEFT_CONTROL, false});
  if (text.empty()) {
    PushKeys({GLFW_KEY_DELETE}, true, input);
    PushKeys({GLFW_KEY_DELETE}, false, input);
  }
  PushText(text, input);
  PushKeys({GLFW_KEY_ENTER}, true, input);
  PushKeys({GLFW_KEY_ENTER}, false, input);
}

}  // namespace arthro::app

// Input events in order, and the part of them that one frame may see. Dear ImGui 1.86 looks at the
// state of mouse and keys once a frame, so two changes of one button between two frames would be
// lost; this queue hands out only as much as one frame can tell apart and keeps the rest. Window
// callbacks and scripts append here. Pointer positions in window coordinates (not scaled), x right,
// y down. Pure: no window, no GL.
#pragma once

#include <deque>
#include <filesystem>
#include <variant>
#include <vector>

namespace arthro::app {

struct PointerMoved {
  double x = 0, y = 0;
};
struct ButtonChanged {
  int button = 0;  // 0 left, 1 right, 2 middle
  bool down = false;
};
struct WheelTurned {
  double x = 0, y = 0;  // notches; y > 0 is away from the user
};
struct KeyChanged {
  int key = 0;  // GLFW_KEY_…
  bool down = false;
};
struct CharacterTyped {
  char32_t character = 0;
};
struct FilesDropped {
  std::vector<std::filesystem::path> files;
};
// New size of the window, in window coordinates; from scripts only.
struct SizeAsked {
  int width = 0, height = 0;
};
struct FocusLost {};       // every held key and button counts as released
struct CloseRequested {};  // the window's close button

using InputEvent = std::variant<PointerMoved, ButtonChanged, WheelTurned, KeyChanged,
                                CharacterTyped, FilesDropped, SizeAsked, FocusLost, CloseRequested>;

class InputQueue {
 public:
  void Push(InputEvent event) { events_.push_back(std::move(event)); }
  bool empty() const { return events_.empty(); }

  // The events of the next frame, oldest first. At most one change of a button, and no move after
  // it; a button-up waits for the frame after a move, so that a quick drag is seen to arrive; one
  // key change, and no key after a character, so that text comes after the key before it.
  std::vector<InputEvent> TakeFrame();

 private:
  std::deque<InputEvent> events_;
};

}  // namespace arthro::app

#include "app/platform/input_queue.h"

namespace arthro::app {
namespace {

// Kinds of events that this frame has seen so far.
struct Seen {
  bool moved = false, wheeled = false, key = false, character = false, button = false;
};

// Can `event` still be told apart from what the frame has seen? If so, it is noted.
struct Fits {
  Seen& seen;

  static bool Note(bool fits, bool& what) {
    if (fits) what = true;
    return fits;
  }
  bool operator()(const PointerMoved&) {
    return Note(!seen.button && !seen.wheeled && !seen.key && !seen.character, seen.moved);
  }
  bool operator()(const ButtonChanged& event) {
    // One change per frame even of different buttons: a press of the second may depend on what the
    // first opened.
    if (!event.down && seen.moved) return false;
    return Note(!seen.button && !seen.wheeled && !seen.key && !seen.character, seen.button);
  }
  bool operator()(const WheelTurned&) {
    return Note(!seen.button && !seen.moved && !seen.key && !seen.character, seen.wheeled);
  }
  bool operator()(const KeyChanged&) {
    return Note(!seen.button && !seen.key && !seen.character, seen.key);
  }
  bool operator()(const CharacterTyped&) {
    return Note(!seen.button, seen.character);  // a key and the text it makes go together
  }
  bool operator()(const FilesDropped&) { return true; }
  bool operator()(const SizeAsked&) { return true; }
  bool operator()(const FocusLost&) {
    return Note(!seen.button && !seen.key && !seen.character, seen.key);
  }
  bool operator()(const CloseRequested&) { return true; }
};

}  // namespace

std::vector<InputEvent> InputQueue::TakeFrame() {
  std::vector<InputEvent> taken;
  Seen seen;
  while (!events_.empty() && std::visit(Fits{seen}, events_.front())) {
    taken.push_back(std::move(events_.front()));
    events_.pop_front();
  }
  return taken;
}

}  // namespace arthro::app

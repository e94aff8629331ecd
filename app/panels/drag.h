// A change of a value by dragging: one step of undo from press to release.
#pragma once

#include "app/panels/widgets.h"
#include "app/state/edits.h"

namespace arthro::app {

inline void Drag(EditorState& state, const Change& change) {
  if (change.held) state.dragging = true;
  if (change.released) EndDrag(state);
}

}  // namespace arthro::app

// The tissue that is chosen in the window.
#pragma once

#include "app/state/editor_state.h"

namespace arthro::app {

// Null where none is chosen.
inline const Tissue* ChosenTissue(const EditorState& state) {
  const auto& tissues = state.document().scene.tissues;
  return state.tissue >= 0 && state.tissue < static_cast<int>(tissues.size())
             ? &tissues[static_cast<std::size_t>(state.tissue)]
             : nullptr;
}

}  // namespace arthro::app

// Purpose of a click in the scope's picture or in the overview, as far as drawing depends on it.
#pragma once

#include "app/state/editor_state.h"

namespace arthro::app {

// A practice shows the scene from outside too, and nothing is edited there.
bool IsTissueEdited(const EditorState& state);
// A click puts a ball, a cut or a region onto the tissue.
bool HasBrush(const EditorState& state);

}  // namespace arthro::app

// The balls of a tissue in the Tissue panel: their list, the chosen one's radius, and how more are
// put onto it.
#pragma once

#include "app/panels/widgets.h"
#include "app/state/editor_state.h"

namespace arthro::app {

void BallFields(Ui& ui, EditorState& state, const Tissue& tissue, BallKind kind);

}  // namespace arthro::app

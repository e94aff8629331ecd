// Cues of an exercise over the scope's picture: a ring about the target, or an arrow at the rim
// towards one that is out of sight; and the targets of the exercise that is edited.
#pragma once

#include "app/panels/fixed_window.h"
#include "app/state/editor_state.h"
#include "simulation/scope/window_lens.h"

namespace arthro::app {

// `window`: of the picture's panel; `picture`: its square.
void MarkTargets(Ui& ui, const EditorState& state, const Area& window, const Area& picture,
                 const simulation::ScopeView& view, const simulation::ScopeOptics& optics);

}  // namespace arthro::app

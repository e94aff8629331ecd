// Cues of an exercise over the scope's picture: a ring about the target, or an arrow at the rim
// towards one that is out of sight.
#pragma once

#include <string>

#include <glm/vec3.hpp>

#include "app/panels/fixed_window.h"
#include "app/state/editor_state.h"
#include "simulation/scope/window_lens.h"

namespace arthro::app {

// `window`: of the picture's panel; `picture`: its square.
void MarkTargets(Ui& ui, const EditorState& state, const Area& window, const Area& picture,
                 const simulation::ScopeView& view, const simulation::ScopeOptics& optics);

// Places that were touched up to the moment of the look back, green, amber or red by the force.
// `name`: of the picture's window.
void MarkTouches(Ui& ui, const EditorState& state, const char* name, const Area& window,
                 const Area& picture, const simulation::ScopeView& view,
                 const simulation::ScopeOptics& optics);

// One ring with a name in the current ImGui window, or one arrow.
void MarkTarget(Ui& ui, const Area& picture, const simulation::ScopeView& view,
                const simulation::ScopeOptics& optics, const glm::dvec3& x_in_portal,
                const std::string& name, bool is_bright);

}  // namespace arthro::app

// Marks of the Depth page over the scope's picture and the overview. The depth brush: its ring on
// the relief, the outer one its size and the inner one its hard core, and the line of the stroke
// under way. The touch preview: a ring on the surface, its normal, and the probe that presses.
// Portal frame, m; areas in window coordinates, px.
#pragma once

#include <functional>
#include <optional>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "app/panels/fixed_window.h"
#include "app/state/editor_state.h"
#include "simulation/scope/window_lens.h"

namespace arthro::app {

// `window`: area of the whole scope page; `picture`: square of the round picture in it.
void MarkBrushInScope(Ui& ui, const EditorState& state, const Area& window, const Area& picture,
                      const simulation::ScopeView& view, const simulation::ScopeOptics& optics);

// `pixel_of`: pixel of the overview for a place, from its top left; nothing behind its camera.
void MarkBrushInOverview(
    Ui& ui, const EditorState& state, const Area& window,
    const std::function<std::optional<glm::dvec2>(const glm::dvec3&)>& pixel_of);

}  // namespace arthro::app

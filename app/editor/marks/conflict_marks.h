// Places where the shafts of scope and instrument are in conflict as the author holds them, over
// the scope's picture and the overview while the Portals page is shown. Portal frame, m; areas in
// window coordinates, px.
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
void MarkConflictsInScope(Ui& ui, EditorState& state, const Area& window, const Area& picture,
                          const simulation::ScopeView& view, const simulation::ScopeOptics& optics);

// `pixel_of`: pixel of the overview for a place, from its top left; nothing behind its camera.
void MarkConflictsInOverview(
    Ui& ui, EditorState& state, const Area& window,
    const std::function<std::optional<glm::dvec2>(const glm::dvec3&)>& pixel_of);

}  // namespace arthro::app

// Numbered marks of landmarks over the scope's picture, the panorama and the overview, and the
// tissue that is placed as an outline, with lines of its distances from the relief. Filled marks
// are points of the model, rings are their places in the scene. Portal frame, m; areas in window
// coordinates, px.
#pragma once

#include <functional>
#include <optional>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "app/editor/marks/model_marks.h"
#include "app/panels/fixed_window.h"
#include "app/state/editor_state.h"
#include "simulation/scope/window_lens.h"

namespace arthro::app {

// `window`: area of the whole scope page; `picture`: square of the round picture in it.
void MarkScope(Ui& ui, EditorState& state, const Area& window, const Area& picture,
               const simulation::ScopeView& view, const simulation::ScopeOptics& optics);

// Marks over the panorama in the current ImGui window, which shows the tissue, too: the panorama
// has none.
void MarkPanorama(const Ui& ui, EditorState& state, const Area& area, const ToWindow& to_window);

// Draws the picture without the chosen tissue over the one with it, `fade` of it; the texture's
// first row is at the top.
void FadeScope(Ui& ui, const Area& window, const Area& picture, unsigned texture, double fade);

// `pixel_of`: pixel of the overview for a place, from its top left; nothing behind its camera.
void MarkOverview(Ui& ui, const EditorState& state, const Area& window,
                  const std::function<std::optional<glm::dvec2>(const glm::dvec3&)>& pixel_of);

}  // namespace arthro::app

// The whole panorama in the place of the scope's picture while the place of a tissue is judged,
// with the tissue over it. While landmarks are placed, a click gives one its place on the relief.
// The wheel and drags zoom and shift the panorama.
#pragma once

#include <glm/vec2.hpp>

#include "app/panels/fixed_window.h"
#include "app/state/editor_state.h"
#include "app/state/settings/picture_zoom.h"

namespace arthro::app {

struct PanoramaClicks {
  bool is_shown = false;
  PictureZoom zoom;
};

// Button that changes between the panorama and the scope's picture, over the area of both.
void PanoramaClicksButton(Ui& ui, const EditorState& state, PanoramaClicks& clicks,
                          const Area& area);
// `texture`: of the panorama, its first row at the top.
void PanoramaPicture(Ui& ui, EditorState& state, PanoramaClicks& clicks, const Area& area,
                     unsigned texture);

}  // namespace arthro::app

// The part of the Panorama page about the rights in each asset, which a scene states before it is
// shared.
#pragma once

#include "app/state/editor_state.h"

namespace arthro::app {

struct Ui;

void RightsFields(Ui& ui, EditorState& state);

}  // namespace arthro::app

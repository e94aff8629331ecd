// Contents of a page while the scene has no panorama: the reason, and the button that leads on.
#pragma once

#include <string>

#include "app/panels/widgets.h"
#include "app/state/editor_state.h"

namespace arthro::app {

// Uses the panorama that was made from footage, where one waits, or opens the Panorama step.
void AskForPanorama(Ui& ui, EditorState& state, const std::string& reason);

}  // namespace arthro::app

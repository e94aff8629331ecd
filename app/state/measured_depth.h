// Puts a measured panorama with its relief into the document, in one step that is undone.
#pragma once

#include <optional>
#include <string>

#include "app/state/editor_state.h"
#include "app/state/footage/measured_backdrop.h"
#include "simulation/scene/lens.h"

namespace arthro::app {

void SetMeasuredPanorama(EditorState& state, const std::string& name,
                         const MeasuredBackdrop& backdrop, const std::optional<Lens>& lens);

}  // namespace arthro::app

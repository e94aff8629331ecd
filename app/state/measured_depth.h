// Edits that put a measured relief into the document, each in one step that is undone.
#pragma once

#include <optional>
#include <string>

#include "app/state/editor_state.h"
#include "app/state/footage/measured_backdrop.h"
#include "simulation/scene/lens.h"

namespace arthro::app {

void SetMeasuredPanorama(EditorState& state, const std::string& name,
                         const MeasuredBackdrop& backdrop, const std::optional<Lens>& lens);
void SetMeasuredDepth(EditorState& state, const std::string& name,
                      const MeasuredBackdrop& backdrop);

}  // namespace arthro::app

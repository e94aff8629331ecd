#include "app/state/measured_depth.h"

#include "app/state/edits.h"

namespace arthro::app {

void SetMeasuredPanorama(EditorState& state, const std::string& name,
                         const MeasuredBackdrop& backdrop, const std::optional<Lens>& lens) {
  Edit(state, name, "", [&](auto& next) { PutMeasuredPanorama(next, backdrop, lens); });
}

}  // namespace arthro::app

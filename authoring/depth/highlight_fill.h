// Glints: where the light mirrors straight into the scope every channel is at the sensor's end and
// the grey says nothing of depth. They are filled from the tissue around them, smoothly.
#pragma once

#include <cstdint>
#include <vector>

#include "authoring/depth/grey_plane.h"

namespace arthro::authoring {

// Fills the imaged pixels that have `highlight` set from the imaged ones that have not, by averages
// over growing squares (push-pull). Nothing changes where there is nothing to fill from.
void FillHighlights(GreyPlane& plane, const std::vector<std::uint8_t>& highlight);

}  // namespace arthro::authoring

// Glints: where the light mirrors straight into the scope the grey says nothing of depth. They are
// pale, small and much brighter than what is around them, whether or not the sensor is at its end.
// They are filled from the tissue around them, smoothly.
#pragma once

#include <cstdint>
#include <vector>

#include "authoring/depth/grey_plane.h"

namespace arthro::authoring {

// 1 at glints and their glow among the imaged pixels. Sizes are shares of the picture's, so that a
// smaller picture of the same scene has the same glints.
std::vector<std::uint8_t> FindHighlights(const GreyPlane& plane,
                                         const std::vector<std::uint8_t>& flags);

// Fills the imaged pixels that have `highlight` set from the imaged ones that have not, by averages
// over growing squares (push-pull). Nothing changes where there is nothing to fill from.
void FillHighlights(GreyPlane& plane, const std::vector<std::uint8_t>& highlight);

}  // namespace arthro::authoring

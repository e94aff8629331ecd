// Specular highlights: the light is reflected straight into the scope there, so the grey says
// nothing about depth. They are pale, small and much brighter than their surroundings, saturated or
// not. They are filled smoothly from the tissue around them.
#pragma once

#include <cstdint>
#include <vector>

#include "authoring/depth/grey_plane.h"

namespace arthro::authoring {

// Returns 1 at highlights and their glow among the imaged pixels. Sizes are shares of the
// picture's, so that a smaller picture of the same scene has the same highlights.
std::vector<std::uint8_t> FindHighlights(const GreyPlane& plane,
                                         const std::vector<std::uint8_t>& flags);

// Fills the imaged pixels with `highlight` set from the imaged ones without, by averages over
// growing squares (push-pull). Changes nothing when there is no pixel to fill from.
void FillHighlights(GreyPlane& plane, const std::vector<std::uint8_t>& highlight);

}  // namespace arthro::authoring

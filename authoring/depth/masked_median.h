// Median over the imaged pixels of a square window [paper, 3.4]. Pixels of the surround and beyond
// the picture's edge do not count, so that the rim is not darkened. An even number of values gives
// the lower of the two middle ones, so every result is a value of the picture.
#pragma once

#include "authoring/depth/grey_plane.h"

namespace arthro::authoring {

// Width of the window is 2 radius + 1; radius 0 changes nothing. Pixels that are not imaged keep
// their grey.
void MaskedMedian(GreyPlane& plane, int radius);

}  // namespace arthro::authoring

// Median over the imaged pixels of a square window [paper, 3.4]. Pixels of the surround
// and beyond the picture's edge do not count, so that the rim is not dragged into the dark. Of an
// even number of values the lower of the two middle ones is taken, so every result is a value of
// the picture.
#pragma once

#include "authoring/depth/grey_plane.h"

namespace arthro::authoring {

// The window is 2 radius + 1 wide; 0 leaves all as it is. Pixels that are not imaged keep their
// grey.
void MaskedMedian(GreyPlane& plane, int radius);

}  // namespace arthro::authoring

// A colour picture, or its part, at another size.
#pragma once

#include "simulation/scene/image.h"
#include "simulation/scene/pixel_bounds.h"

namespace arthro::authoring {

// Each pixel is the mean of those that it covers where the picture becomes narrower, and else a
// linear mean of its neighbours. `width`, `height`: px, above 0. An empty picture stays empty.
ColourImage Resized(const ColourImage& picture, int width, int height);
// The same of the part within `box`, which lies in the picture.
ColourImage Resized(const ColourImage& picture, const PixelBounds& box, int width, int height);

}  // namespace arthro::authoring

// Relief and colours where none are known, continued from what is known around them, so that the
// known part ends in no cliff towards the bare sphere and in no black seam. Plain values, no
// OpenGL.
#pragma once

#include "simulation/scene/image.h"

namespace arthro::app {

// Replaces unknown values (NaN) by means of the known ones around them, over ever larger blocks,
// by pull and push [Gortler et al. 1996]. Known values stay. A map without any becomes 0.
void FillUnknown(DepthMap& relief);

// The same for the colours of pixels that were not imaged: dark ones, where the depth is unknown. A
// map of another size than the panorama counts as known.
void FillUnimaged(ColourImage& panorama, const DepthMap& depth);
// Whether another depth map of a panorama would fill other pixels.
bool FillsOthers(const ColourImage& panorama, const DepthMap& before, const DepthMap& after);

}  // namespace arthro::app

// Relief where none is known, continued from what is known around it, so that the known part ends
// in no cliff towards the bare sphere. Plain values, no OpenGL.
#pragma once

#include "simulation/scene/image.h"

namespace arthro::app {

// Replaces unknown values (NaN) by means of the known ones around them, over ever larger blocks,
// by pull and push [Gortler et al. 1996]. Known values stay. A map without any becomes 0.
void FillUnknown(DepthMap& relief);

}  // namespace arthro::app

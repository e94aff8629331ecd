// Noise of the camera's sensor. Plain values, no OpenGL.
#pragma once

#include "app/view/drawing/picture.h"

namespace arthro::app {

// Returns a number of the picture's pose and of the time of moving disturbances: a scope at rest
// keeps its grain, and any motion renews it.
int GrainSeed(const Picture& picture) noexcept;

}  // namespace arthro::app

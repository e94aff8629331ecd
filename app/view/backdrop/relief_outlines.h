// Antialiasing of outlines in a depth map. A texel only knows whether it is near or far, so a line
// between the two is a staircase, which grows as the lens comes nearer. Plain values, no OpenGL.
#pragma once

#include "simulation/scene/image.h"

namespace arthro::app {

// Returns the map with outlines laid straight through their staircases, as morphological
// antialiasing does in pictures [Reshetov 2009]. An outline passes through the middle of each step
// and is straight between two of them. The texels beside it become mixtures of near and far by
// their distance from it, so that bilinear interpolation draws a ramp along the line. An outline is
// a step of 0.15 mm or more between neighbouring texels, with less than half of it before and
// after: slopes that are merely steep stay, and so do all texels that are not next to an outline.
// Unknown texels (NaN) stay unknown. `sigma`: standard error of the relief, m, of its size; a step
// that it explains is no outline. Empty: not known.
void SmoothOutlines(DepthMap& relief, bool whole_turn, const DepthMap& sigma = {});

}  // namespace arthro::app

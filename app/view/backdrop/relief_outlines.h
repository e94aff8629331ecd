// Outlines of what stands before something else, in a depth map: a texel knows only whether it is
// before or behind, so a line between them is a stair, and the nearer the lens comes the larger are
// its teeth. Plain values, no OpenGL.
#pragma once

#include "simulation/scene/image.h"

namespace arthro::app {

// The same map with its outlines laid straight through their stairs, after the way in which
// morphological antialiasing finds them in pictures [Reshetov 2009]: where a stair goes a step up
// or down the outline passes through the middle of that step, and between two of these it is
// straight. The texels beside it become as much of near and far as its distance from them says, so
// that bilinear interpolation draws a ramp along the line and not along the stair. An outline is a
// step of 0.15 mm or more of one texel to the next with less than half of it before and after: what
// is merely steep stays as it is, and so do all texels that are not next to an outline. Unknown
// (NaN) stays unknown.
void SmoothOutlines(DepthMap& relief, bool whole_turn);

}  // namespace arthro::app

// Antialiasing of the colours of a panorama at creases and steps of its relief. A panorama without
// antialiasing, as a computed one, has staircases there, which grow as the lens comes nearer. Plain
// values, no OpenGL.
#pragma once

#include "simulation/scene/image.h"

namespace arthro::app {

// Averages the colours beside a crease along it, over the length of a stair: its direction is that
// of the smallest change of the luma [Weickert 1999]. A crease is a second difference of the relief
// of 0.08 mm between neighbouring texels, or a step, where the luma changes by 10 levels. `depth`
// and `sigma` (its standard error; empty: not known) have the panorama's size. Does nothing without
// a depth map of that size, nothing at creases that the error explains, and nothing where the luma
// has no clear direction.
void SmoothColourOutlines(ColourImage& panorama, const DepthMap& depth, bool whole_turn,
                          const DepthMap& sigma = {});

}  // namespace arthro::app

// Noise of a depth map whose scene states none [method.md, Backdrop]. Maps from elsewhere carry no
// standard error; one that is noise from pixel to pixel would be drawn and felt as spikes.
#pragma once

#include <optional>

#include "simulation/scene/image.h"
#include "simulation/scene/scene.h"

namespace arthro {

// Standard deviation of white noise, m, if it is so large that neighbouring pixels differ by more
// than their distance (slopes of 45 degrees by noise alone); otherwise nothing. It is the median of
// |h(x-1) - 2 h(x) + h(x+1)| over 0.6745 √6, which a smooth surface and its steps leave small.
// About 2^16 pixels are looked at.
std::optional<float> SteepNoise(const DepthMap& depth, const Backdrop& backdrop);

}  // namespace arthro

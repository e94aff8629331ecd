// Relief of a noisy depth map to be drawn while its noise is being removed: the smoothing of
// WithoutNoise (relief_smoothing.h), done with means of blocks of pixels. Takes a small part of the
// time, and draws steps as ramps as wide as a block. Plain values, no OpenGL.
#pragma once

#include "simulation/scene/image.h"
#include "simulation/scene/scene.h"

namespace arthro::app {

// Most blocks that a map is divided into; their side is the least that keeps to it.
inline constexpr int kMostBlocks = 100'000;
int BlockSide(const DepthMap& depth);

// Values at the texels of SampledRelief(depth); unknown depths stay unknown. `sigma`: standard
// error of the depth map, of its size.
DepthMap RoughRelief(const DepthMap& depth, const DepthMap& sigma, const Backdrop& backdrop);

}  // namespace arthro::app

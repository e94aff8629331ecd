// Noise of a relief from brightness. Vessels, fat and glare make tissue brighter or darker without
// being nearer, so the finest structure of such a relief is the tissue's texture, not its shape.
#pragma once

#include "simulation/scene/image.h"

namespace arthro::authoring {

// Standard deviation of the structure that is finer than `texture_size` px, m, per pixel of
// `depth`; NaN where the depth is. It is 1.48 times the median distance of the relief from its
// weighted mean over texture_size px, in windows of six times that size; beside a step it is
// larger. Windows differ from the median over the whole map by a factor of two at most. Empty where
// `texture_size` is 0 or the relief has no such structure.
DepthMap NoiseOfDepth(const DepthMap& depth, int texture_size);

}  // namespace arthro::authoring

// Distance from the light that comes back, for a light at the scope: brightness = albedo × cosine /
// distance² [method.md, Depth from brightness]. An estimate that ranks what is nearer, not a
// measurement of shape: tissue colour, light that bounces and what composition did to the light
// remain in it.
//
// On a single rectified frame the law holds as written. A panorama has had its light evened out:
// each frame's falloff over its mean plane was divided away, so slow depth is gone, and what is
// left is how much nearer or further than that plane a place is: brightness = albedo × cosine ×
// (plane / distance)². The same formula then gives distance relative to the plane, seen along the
// panorama's own rays, which is why there is no vignette to undo (its default is 0).
#pragma once

#include <cstdint>
#include <vector>

#include "authoring/depth/depth_options.h"
#include "authoring/depth/grey_plane.h"
#include "simulation/core/progress.h"
#include "simulation/scene/image.h"

namespace arthro::authoring {

// Distance relative to the median of the imaged pixels, NaN elsewhere; row-major. `highlight` marks
// pixels that say nothing and are filled from around them; empty: none.
std::vector<float> DistanceFromLight(const ColourImage& picture, const GreyPlane& plane,
                                     const std::vector<std::uint8_t>& highlight,
                                     const DepthOptions& options, const Progress& progress = {});

}  // namespace arthro::authoring

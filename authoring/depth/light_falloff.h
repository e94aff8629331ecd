// Distance from reflected light, for a light at the scope: brightness = albedo × cosine / distance²
// [method.md, Depth from brightness]. The estimate ranks depth and does not measure shape: errors
// by tissue colour, interreflection and the composition of the panorama remain.
//
// On a single rectified frame the law holds as written. A panorama has evened-out light: each frame
// was divided by its falloff over its mean plane, so slow changes of depth are lost. The remainder
// is the position relative to that plane: brightness = albedo × cosine × (plane / distance)². The
// same formula then gives distance relative to the plane along the panorama's own rays. A panorama
// therefore has no vignetting to correct (its default is 0).
#pragma once

#include <cstdint>
#include <vector>

#include "authoring/depth/depth_options.h"
#include "authoring/depth/grey_plane.h"
#include "simulation/core/progress.h"
#include "simulation/scene/image.h"

namespace arthro::authoring {

// Distance relative to the median of the imaged pixels, NaN elsewhere; row-major. `highlight` marks
// pixels that are filled from their surroundings; empty: none.
std::vector<float> DistanceFromLight(const ColourImage& picture, const GreyPlane& plane,
                                     const std::vector<std::uint8_t>& highlight,
                                     const DepthOptions& options, const Progress& progress = {});

}  // namespace arthro::authoring

// Maps of a relief at the size of its panorama.
#pragma once

#include "simulation/scene/image.h"

namespace arthro::authoring {

// Linear between the cells; across a difference of more than `most_step`, and beside an unknown
// cell, the nearest one, so that no ramp spans a step.
DepthMap EnlargedMap(const DepthMap& map, int factor, float most_step);

OriginMap EnlargedMap(const OriginMap& map, int factor);

}  // namespace arthro::authoring

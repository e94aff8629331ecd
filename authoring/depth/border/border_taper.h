// Relief near the border of the imaged area. What the border cuts has no known shape, and
// brightness makes a wall of it that stands over nothing. So the relief goes over to its broad mean
// there.
#pragma once

#include <cstdint>
#include <vector>

#include "simulation/scene/image.h"

namespace arthro::authoring {

// Changes the relief, m, within `band` px of a pixel that is not `imaged`, or of the picture's
// edge. The mean is over a square of four times the band. A band of less than a pixel changes
// nothing.
void TaperToBorder(DepthMap& depth, const std::vector<std::uint8_t>& imaged, double band);

}  // namespace arthro::authoring

// Steps of a relief from brightness. Where one tissue is brighter than its neighbour, brightness
// makes a wall between them, mostly where there is none, and a wall has no picture: seen from the
// side it smears. So a step is made as wide as a slope.
#pragma once

#include "simulation/scene/image.h"

namespace arthro::authoring {

// Makes the relief, m, the mean of the highest relief below it and the lowest above it that nowhere
// change by more than `steepest`, m per px. A step alone so gets half of that slope. Lengths are
// those of ways along rows, columns and diagonals, at most 9 % too long. Unknown pixels stay, and
// ways lead round them. A relief that is no steeper stays as it is, bit for bit. A `steepest` that
// is not above 0, or is no number, changes nothing.
void LimitSteepness(DepthMap& depth, double steepest);

}  // namespace arthro::authoring

// How much of one grid cell is solid: the part of the unit cube in which the trilinear
// interpolation of its corner values is negative.
#pragma once

#include <array>

namespace arthro::simulation {

// Corner values in the order x fastest, z slowest. 0 to 1. Exact along lines of one axis (the one
// of the steepest change), 4 × 4 of which are summed: the error is about 1e-3 of a cell that the
// surface passes through, of either sign.
double SolidPart(const std::array<double, 8>& corner) noexcept;

}  // namespace arthro::simulation

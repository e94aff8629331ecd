// Solid fraction of one grid cell: the part of the unit cube in which the trilinear interpolation
// of the corner values is negative.
#pragma once

#include <array>

namespace arthro::simulation {

// Returns the fraction, 0 to 1; corner values run x fastest, z slowest. Sums 4 × 4 lines along the
// axis of the steepest change, each of which is exact. The error is about 1e-3 of a cell that the
// surface passes through, of either sign.
double SolidPart(const std::array<double, 8>& corner) noexcept;

}  // namespace arthro::simulation

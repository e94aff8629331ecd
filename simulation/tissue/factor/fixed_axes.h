// Which axes of which nodes do not move by forces: they stay where they are, or go where they are
// led. One byte a node; bits 1, 2, 4 are x, y, z of the mesh's own frame. Empty: none.
#pragma once

#include <cstdint>
#include <vector>

namespace arthro::simulation {

using FixedAxes = std::vector<std::uint8_t>;

}  // namespace arthro::simulation

// Axes of nodes that do not respond to forces: they are fixed or have a prescribed motion. One byte
// per node; bits 1, 2, 4 are x, y, z of the mesh's own frame. Empty: no fixed axes.
#pragma once

#include <cstdint>
#include <vector>

namespace arthro::simulation {

using FixedAxes = std::vector<std::uint8_t>;

}  // namespace arthro::simulation

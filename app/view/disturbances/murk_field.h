// Densities of blood in the fluid, and of dew on the lens, over the window: a small texture,
// computed for each moment as a closed function of seed and time.
#pragma once

#include <cstdint>
#include <vector>

namespace arthro::app {

inline constexpr int kMurkSize = 96;  // texels per side, over the whole window

// RGBA: density of the near and of the far fluid, as shares of twice the mean; unevenness of the
// dew; 255. The first row is the lowest.
std::vector<std::uint8_t> MurkField(int seed, double time);

}  // namespace arthro::app

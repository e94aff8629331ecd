// Tissue presets that the program ships, for jobs without a window.
#pragma once

#include <vector>

#include "simulation/tissue/body/tissue_preset.h"

namespace arthro::app {

std::vector<simulation::TissuePreset> ShippedTissuePresets();

}  // namespace arthro::app

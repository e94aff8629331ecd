// Tissue presets that the program ships, for jobs without a window.
#pragma once

#include <vector>

#include "simulation/tissue/body/tissue_preset.h"

namespace arthro::app {

std::vector<simulation::TissuePreset> ShippedTissuePresets();

// Looks of a scene's tissues. Prints a note for a tissue that is drawn without one: its preset has
// none, or a preset cannot be read.
std::vector<simulation::TissueLook> ShippedLooks(const Scene& scene);

}  // namespace arthro::app

// The living tissues of a scene as jobs compute them: with the presets that the program ships. What
// reading their meshes repaired is said on stderr.
#pragma once

#include <vector>

#include "simulation/practice/living_tissues.h"
#include "simulation/scene/scene_io.h"

namespace arthro::app {

// Those that the program ships.
std::vector<simulation::TissuePreset> ShippedTissuePresets();
std::vector<simulation::BodySpec> LivingTissuesOf(const LoadedScene& loaded);
std::vector<simulation::LayerSpec> LayersOf(const LoadedScene& loaded);

}  // namespace arthro::app

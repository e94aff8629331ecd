// The lenses that a clip may have been filmed through: none, the presets that come with the
// program, files that the user named.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "authoring/lens/lens_preset.h"
#include "simulation/scene/lens.h"

namespace arthro::app {

struct LensChoice {
  std::string words;  // its line in the list
  std::string help;   // a sentence
  std::optional<Lens> lens;
  std::optional<authoring::LensPreset> preset = {};
  std::string problem = {};  // why the preset gives no lens for this clip
};

// None first, then every preset in `folder` by its name. A folder that is not there holds none; nor
// does one with a broken file, for the program must open.
std::vector<LensChoice> LensChoices(const std::filesystem::path& folder);

// The presets' lenses on frames of this size with the round window there; radius 0: there is none.
void FitPresets(std::vector<LensChoice>& choices, int width, int height, const LensCircle& circle);

// Throws Error(kBadData) for what is no lens.
LensChoice LensFromFile(const std::filesystem::path& file);

}  // namespace arthro::app

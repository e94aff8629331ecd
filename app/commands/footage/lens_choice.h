// The lenses that a clip may have been filmed through: none, the presets that come with the
// program, files that the user named.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "simulation/scene/lens.h"

namespace arthro::app {

struct LensChoice {
  std::string words;  // as the list shows it
  std::string help;   // a sentence
  std::optional<Lens> lens;
};

// None first, then every lens file in `folder` by its name; files that cannot be read are passed
// over, for the program must open. A folder that is not there holds none.
std::vector<LensChoice> LensChoices(const std::filesystem::path& folder);

// Throws Error(kBadData) for what is no lens.
LensChoice LensFromFile(const std::filesystem::path& file);

}  // namespace arthro::app

// Lenses by name, for footage whose camera cannot be calibrated any more. A preset says the model
// and the field of view; where the window lies is measured in the footage. It also says what is
// known of the lens and what is only assumed.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "simulation/scene/lens.h"

namespace arthro::authoring {

struct LensPreset {
  std::string name;  // of the file, without .json
  std::string title, known, assumed;
  LensModel model = LensModel::kEquisolid;
  double field_of_view = 0;  // full, rad
  double aspect = 1;
};

// Throws Error(kBadData) that names the key at fault.
LensPreset ReadLensPreset(const std::filesystem::path& file);
// All of a folder (resources/presets/lenses), by name.
std::vector<LensPreset> ReadLensPresets(const std::filesystem::path& folder);

// The preset's lens on pictures of this size. Throws Error(kBadArgument) without a round window,
// which alone says where the field of view ends.
Lens LensFromPreset(const LensPreset& preset, int width, int height, const LensCircle& circle);

}  // namespace arthro::authoring

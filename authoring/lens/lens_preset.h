// Named lenses for footage whose camera can no longer be calibrated. A preset gives the model and
// the field of view; the position of the window is measured in the footage. A preset also states
// which of its properties are known and which are assumed.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "simulation/scene/lens.h"

namespace arthro::authoring {

struct LensPreset {
  std::string name;  // name of the file, without .json
  std::string title, known, assumed;
  LensModel model = LensModel::kEquisolid;
  double field_of_view = 0;  // full, rad
  double aspect = 1;
  std::optional<double> view_angle;  // rad, of the scope that the lens belongs to
  LensCamera camera;
};

// Throws Error(kBadData) that names the faulty key.
LensPreset ReadLensPreset(const std::filesystem::path& file);
// Reads all presets of a folder (resources/presets/lenses), by name.
std::vector<LensPreset> ReadLensPresets(const std::filesystem::path& folder);

// Lens of the preset for pictures of this size. Throws Error(kBadArgument) without a round window,
// which alone shows where the field of view ends.
Lens LensFromPreset(const LensPreset& preset, int width, int height, const LensCircle& circle);

}  // namespace arthro::authoring

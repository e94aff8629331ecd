#include "app/cli/practice/shipped_presets.h"

#include "app/platform/resource_folder.h"

namespace arthro::app {

std::vector<simulation::TissuePreset> ShippedTissuePresets() {
  return simulation::ReadTissuePresets(ResourceFolder() / "presets" / "tissues");
}

}  // namespace arthro::app

#include "app/cli/practice/shipped_presets.h"

#include <cstdio>

#include <fmt/format.h>

#include "app/platform/resource_folder.h"
#include "simulation/core/error.h"

namespace arthro::app {

std::vector<simulation::TissuePreset> ShippedTissuePresets() {
  return simulation::ReadTissuePresets(ResourceFolder() / "presets" / "tissues");
}

std::vector<simulation::TissueLook> ShippedLooks(const Scene& scene) {
  try {
    const std::vector<simulation::TissuePreset> presets = ShippedTissuePresets();
    for (const Tissue& tissue : scene.tissues) {
      const simulation::TissuePreset* found = FindTissuePreset(presets, tissue.material);
      if (found == nullptr)
        fmt::print(stderr, "note: there is no preset {}; {} is drawn without structure\n",
                   PrintableLine(tissue.material), PrintableLine(tissue.name));
      if (found != nullptr && !found->look)
        fmt::print(stderr, "note: the preset {} has no \"look\"; {} is drawn without structure\n",
                   found->name, PrintableLine(tissue.name));
    }
    return simulation::LooksOf(scene.tissues, presets);
  } catch (const Error& error) {
    fmt::print(stderr, "note: {}; tissues are drawn without structure\n",
               PrintableLine(error.what()));
    return {};
  }
}

}  // namespace arthro::app

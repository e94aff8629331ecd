#include "app/cli/practice/living_tissues_of.h"

#include <fmt/format.h>

#include "app/platform/resource_folder.h"
#include "simulation/core/error.h"
#include "simulation/scene/archive_io.h"

namespace arthro::app {

std::vector<simulation::TissuePreset> ShippedTissuePresets() {
  return simulation::ReadTissuePresets(ResourceFolder() / "presets" / "tissues");
}

std::vector<simulation::BodySpec> LivingTissuesOf(const LoadedScene& loaded) {
  std::vector<std::string> messages;
  std::vector<simulation::BodySpec> bodies;
  try {
    bodies = simulation::LivingTissues(
        loaded.scene, loaded.surfaces,
        [&loaded](const std::filesystem::path& name) { return loaded.folder / name; },
        ShippedTissuePresets(), &messages);
  } catch (const Error& error) {
    if (loaded.archive.empty()) throw;
    throw NamedByArchive(error, loaded.folder, loaded.archive);
  }
  for (const std::string& message : messages)
    fmt::print(stderr, "note: {}\n", PrintableLine(message));
  return bodies;
}

std::vector<simulation::LayerSpec> LayersOf(const LoadedScene& loaded) {
  return simulation::LayersOf(loaded.scene, loaded.surfaces, ShippedTissuePresets());
}

}  // namespace arthro::app

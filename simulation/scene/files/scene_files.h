// Files that a scene names, relative to its folder. Whoever packs, copies or guards a scene asks
// here, so that a new field is not forgotten by one of them.
#pragma once

#include <filesystem>
#include <vector>

#include "simulation/scene/scene.h"

namespace arthro {

// Panorama, depth map with its standard error and origins, lens, surfaces, meshes, and pictures and
// recordings of exercises, as the scene writes them; empty ones left out.
std::vector<std::filesystem::path> FilesNamedBy(const Scene& scene);

}  // namespace arthro

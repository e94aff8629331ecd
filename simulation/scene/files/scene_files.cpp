#include "simulation/scene/files/scene_files.h"

namespace arthro {

std::vector<std::filesystem::path> FilesNamedBy(const Scene& scene) {
  const Backdrop& backdrop = scene.backdrop;
  std::vector<std::filesystem::path> files = {backdrop.panorama, backdrop.depth,
                                              backdrop.depth_sigma, backdrop.depth_origin,
                                              scene.scope.lens};
  for (const Tissue& tissue : scene.tissues) {
    files.push_back(tissue.surface);
    files.push_back(tissue.mesh);
  }
  std::erase_if(files, [](const std::filesystem::path& file) { return file.empty(); });
  return files;
}

}  // namespace arthro

#include "simulation/scene/files/scene_files.h"

namespace arthro {

std::vector<std::filesystem::path> FilesNamedBy(const Scene& scene) {
  const Backdrop& backdrop = scene.backdrop;
  std::vector<std::filesystem::path> files = {backdrop.panorama,    backdrop.depth,
                                              backdrop.depth_sigma, backdrop.depth_origin,
                                              backdrop.footage,     scene.scope.lens};
  for (const Tissue& tissue : scene.tissues) {
    files.push_back(tissue.surface);
    files.push_back(tissue.mesh);
  }
  for (const Exercise& exercise : scene.exercises) {
    files.push_back(exercise.picture);
    files.push_back(exercise.ghost);
    for (const ExerciseStep& step : exercise.steps) files.push_back(BaseOf(step).picture);
  }
  std::erase_if(files, [](const std::filesystem::path& file) { return file.empty(); });
  return files;
}

}  // namespace arthro

#include "simulation/scene/files/scene_files.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "simulation/core/error.h"
#include "simulation/core/json_text.h"

namespace arthro {

std::map<std::string, std::filesystem::path> UnmendedFilesOf(const Scene& scene) {
  std::map<std::string, std::filesystem::path> files;
  const auto key = scene.extensions.find(kUnmendedDepthKey);
  if (key == scene.extensions.end()) return files;
  nlohmann::json json;
  try {
    json = ParseJson(key->second, Code::kBadScene);
  } catch (const Error&) {
    return files;
  }
  for (const char* word : {"depth", "sigma", "origin"})
    if (const auto name = json.is_object() ? json.find(word) : json.end();
        name != json.end() && name->is_string())
      files[word] = name->get<std::string>();
  return files;
}

std::vector<ExerciseFile> ExerciseFilesOf(Scene& scene) {
  std::vector<ExerciseFile> files;
  for (std::size_t i = 0; i < scene.exercises.size(); ++i) {
    Exercise& exercise = scene.exercises[i];
    files.push_back({fmt::format("exercises[{}].picture", i), &exercise.picture, true});
    files.push_back({fmt::format("exercises[{}].ghost", i), &exercise.ghost, false});
    for (std::size_t k = 0; k < exercise.steps.size(); ++k)
      files.push_back({fmt::format("exercises[{}].steps[{}].picture", i, k),
                       &BaseOf(exercise.steps[k]).picture, true});
  }
  std::erase_if(files, [](const ExerciseFile& file) { return file.name->empty(); });
  return files;
}

std::vector<std::filesystem::path> FilesNamedBy(const Scene& scene) {
  const Backdrop& backdrop = scene.backdrop;
  std::vector<std::filesystem::path> files = {backdrop.panorama,    backdrop.depth,
                                              backdrop.depth_sigma, backdrop.depth_origin,
                                              backdrop.footage,     scene.scope.lens};
  for (const Tissue& tissue : scene.tissues) {
    files.push_back(tissue.surface);
    files.push_back(tissue.mesh);
  }
  Scene named = scene;
  for (const ExerciseFile& file : ExerciseFilesOf(named)) files.push_back(*file.name);
  for (const auto& [word, file] : UnmendedFilesOf(scene)) files.push_back(file);
  std::erase_if(files, [](const std::filesystem::path& file) { return file.empty(); });
  return files;
}

}  // namespace arthro

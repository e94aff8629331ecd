#include "simulation/scene/files/loaded_scene.h"

#include "simulation/scene/files/archive_io.h"

namespace arthro {

LoadedScene::LoadedScene() = default;
LoadedScene::LoadedScene(const LoadedScene&) = default;
LoadedScene::LoadedScene(LoadedScene&&) noexcept = default;
LoadedScene& LoadedScene::operator=(const LoadedScene&) = default;
LoadedScene& LoadedScene::operator=(LoadedScene&&) noexcept = default;
LoadedScene::~LoadedScene() = default;

void SetDepth(LoadedScene& loaded, std::shared_ptr<const DepthMap> depth) {
  if (depth && depth == loaded.depth) return;
  loaded.depth = std::move(depth);
  loaded.depth_sigma = nullptr;
  loaded.depth_origin = nullptr;
  loaded.scene.backdrop.depth_sigma.clear();
  loaded.scene.backdrop.depth_origin.clear();
}

std::filesystem::path FileOf(const LoadedScene& loaded, const std::filesystem::path& name) {
  const auto found = loaded.files.find(name.generic_string());
  return found != loaded.files.end() ? found->second.file : loaded.folder / name;
}

Error NamedByScene(const Error& fault, const LoadedScene& loaded) {
  return loaded.unpacked ? NamedByArchive(fault, loaded.unpacked->path(), loaded.folder) : fault;
}

}  // namespace arthro

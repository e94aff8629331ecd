#include "app/state/scratch_folder.h"

#include "authoring/project/files/asset_writer.h"

namespace arthro::app {

const std::filesystem::path& ScratchFolder::path() {
  if (!folder_) folder_.emplace();
  return folder_->path();
}

std::filesystem::path ScratchFolder::NewFile(const std::filesystem::path& name) {
  int number = 1;
  while (std::filesystem::exists(path() / authoring::Numbered(name, number))) ++number;
  return path() / authoring::Numbered(name, number);
}

}  // namespace arthro::app

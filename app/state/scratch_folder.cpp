#include "app/state/scratch_folder.h"

namespace arthro::app {

const std::filesystem::path& ScratchFolder::path() {
  if (!folder_) folder_.emplace();
  return folder_->path();
}

}  // namespace arthro::app

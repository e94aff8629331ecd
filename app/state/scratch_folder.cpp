#include "app/state/scratch_folder.h"

#include <system_error>

#include "simulation/core/leftovers.h"

namespace arthro::app {

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
}

const std::filesystem::path& ScratchFolder::path() {
  if (!path_.empty()) return path_;
  path_ = MakeTemporaryFolder();
  return path_;
}

}  // namespace arthro::app

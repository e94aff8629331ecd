// Folder for files that are not saved yet: made when it is first asked for, removed at the end.
#pragma once

#include <filesystem>
#include <optional>

#include "simulation/core/folders/temporary_folder.h"

namespace arthro::app {

class ScratchFolder {
 public:
  // Throws Error(kFile) when it cannot be made.
  const std::filesystem::path& path();
  // A name in the folder that no file has yet, with a number if need be: earlier steps of the
  // history go on to name the earlier files.
  std::filesystem::path NewFile(const std::filesystem::path& name);

 private:
  std::optional<TemporaryFolder> folder_;
};

}  // namespace arthro::app

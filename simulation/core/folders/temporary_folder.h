// Folder of this process under the system's temporary one (leftovers.h), removed at the end.
#pragma once

#include <filesystem>
#include <system_error>

#include "simulation/core/folders/leftovers.h"

namespace arthro {

class TemporaryFolder {
 public:
  TemporaryFolder() : path_(MakeTemporaryFolder()) {}  // throws Error(kFile)
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace arthro

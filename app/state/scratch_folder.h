// A folder for files that are not saved yet: made when it is first asked for, removed at the end.
#pragma once

#include <filesystem>

namespace arthro::app {

class ScratchFolder {
 public:
  ScratchFolder() = default;
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  // Throws Error(kFile) when it cannot be made.
  const std::filesystem::path& path();

 private:
  std::filesystem::path path_;
};

}  // namespace arthro::app

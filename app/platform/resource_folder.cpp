#include "app/platform/resource_folder.h"

#include "simulation/core/error.h"

namespace arthro::app {

std::filesystem::path ResourceFolder() {
  namespace fs = std::filesystem;
  std::error_code ignored;
  // <prefix>/bin/arthroscene -> <prefix>/share/arthroscene
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
  const fs::path installed = program.parent_path().parent_path() / "share" / "arthroscene";
  for (const fs::path& folder : {installed, fs::path(ARTHRO_RESOURCE_FOLDER)})
    if (fs::is_directory(folder, ignored)) return folder;
  throw Error(Code::kFile, "the program's own files are not here; install it again", installed);
}

bool IsInResourceFolder(const std::filesystem::path& place) {
  std::error_code ignored;
  const std::filesystem::path within =
      std::filesystem::weakly_canonical(place, ignored)
          .lexically_relative(std::filesystem::canonical(ResourceFolder(), ignored));
  return !within.empty() && *within.begin() != "..";
}

}  // namespace arthro::app

#include "app/commands/scratch_folder.h"

#include <cstdlib>
#include <string>
#include <system_error>

#include "simulation/core/error.h"

namespace arthro::app {

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
}

const std::filesystem::path& ScratchFolder::path() {
  if (!path_.empty()) return path_;
  std::error_code ignored;
  std::string name =
      (std::filesystem::temp_directory_path(ignored) / "arthroscene_XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr)
    throw Error(Code::kFile,
                "no folder for temporary files can be made here; free some space or set TMPDIR",
                name);
  path_ = name;
  return path_;
}

}  // namespace arthro::app

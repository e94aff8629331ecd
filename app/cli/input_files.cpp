#include "app/cli/input_files.h"

#include <exception>
#include <string>
#include <system_error>

#include "authoring/footage/picture_list.h"
#include "simulation/core/error.h"
#include "simulation/scene/files/archive_io.h"
#include "simulation/scene/files/scene_files.h"
#include "simulation/scene/files/scene_io.h"

namespace arthro::app {

namespace fs = std::filesystem;

std::vector<fs::path> FilesOfScene(const fs::path& scene) {
  std::vector<fs::path> files{SceneFile(scene)};
  if (IsArchive(scene)) return files;
  try {
    for (const fs::path& name : FilesNamedBy(ReadScene(scene)))
      files.push_back(files.front().parent_path() / name);
  } catch (const std::exception&) {
  }
  return files;
}

std::vector<fs::path> FilesOfFootage(const fs::path& footage) {
  std::error_code ignored;
  try {
    if (fs::is_directory(footage, ignored)) return authoring::PicturesIn(footage);
    if (!fs::exists(footage, ignored) && footage.filename().string().find('%') != std::string::npos)
      return authoring::PicturesOf(footage);
  } catch (const Error&) {  // no picture there; the job says so itself
    return {};
  }
  return {footage};
}

bool IsFrameName(const fs::path& file) { return authoring::IsPictureName(file); }

}  // namespace arthro::app

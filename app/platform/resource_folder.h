// Folder of the files of resources/: beside an installed program, or in the source tree it was
// built from.
#pragma once

#include <filesystem>

namespace arthro::app {

// Throws Error(kFile) that says what was looked for when neither is there.
std::filesystem::path ResourceFolder();

}  // namespace arthro::app

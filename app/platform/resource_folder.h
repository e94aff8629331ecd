// Folder of the files of resources/: beside an installed program, or in the source tree it was
// built from.
#pragma once

#include <filesystem>

namespace arthro::app {

// Throws Error(kFile) that says what was looked for when neither is there.
std::filesystem::path ResourceFolder();

// The file or folder, which may not be there yet, lies in it.
bool IsInResourceFolder(const std::filesystem::path& place);

}  // namespace arthro::app

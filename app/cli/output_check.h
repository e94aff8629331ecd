// Checks of the outputs of a job before its long part, so that a wrong name costs no time.
#pragma once

#include <filesystem>
#include <vector>

namespace arthro::app {

// Throws Error(kBadArgument) where an output would overwrite one of `inputs` or another output, and
// Error(kFile) where its folder is not there. Outputs that are empty or - are left out.
void CheckOutputs(const std::vector<std::filesystem::path>& outputs,
                  const std::vector<std::filesystem::path>& inputs);

// The same for a folder that a job makes and fills; it may be there already.
void CheckOutputFolder(const std::filesystem::path& folder,
                       const std::vector<std::filesystem::path>& files);

}  // namespace arthro::app

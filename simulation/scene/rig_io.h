// Rig files: JSON of resources/schemas/rig-1.schema.json.
#pragma once

#include <filesystem>
#include <string>

#include "simulation/scene/rig_file.h"

namespace arthro {

// Throws Error(kBadData) with the key and what is wrong: unknown keys and families, lengths that
// cannot be or were swapped, one device in two roles, roles that only a port would tell apart.
RigFile ParseRig(const std::string& text, const std::filesystem::path& file = {});
RigFile ReadRig(const std::filesystem::path& file);

}  // namespace arthro

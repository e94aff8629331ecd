// Rig files: JSON by the fields that rig_file.h lists. The schema for other tools is
// resources/schemas/rig-1.schema.json; `arthroscene check --rig-schema` prints it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "simulation/scene/json/rig_file.h"

namespace arthro {

// Throws Error(kBadData) with the key and what is wrong: unknown keys and families, lengths that
// cannot be or were swapped, one device in two roles, roles that only a port would tell apart.
RigFile ParseRig(const std::string& text, const std::filesystem::path& file = {});
RigFile ReadRig(const std::filesystem::path& file);

std::string RigSchemaText();

// Calibrated incisions in the frames of a rig's devices; m.
struct RigPivots {
  std::optional<glm::dvec3> scope, instrument;  // none: as it is
};

// The rig `text` with these pivots and all else as it stands there, keys that only people read
// included. Throws Error(kBadData) where the text is no rig or does not name such a device.
std::string RigTextWith(const RigPivots& pivots, const std::string& text,
                        const std::filesystem::path& file = {});
// The same from one file to another, which may be the same; whole or not at all. Throws Error.
void WriteRigWith(const RigPivots& pivots, const std::filesystem::path& from,
                  const std::filesystem::path& to);

}  // namespace arthro

// A scene as one file: a zip archive named .arthro with scene.json at its top [method.md, Scene].
// Archives may be hostile, so unpacking never writes outside the folder, never fills the disk and
// creates plain files only.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "simulation/core/error.h"
#include "simulation/core/folders/temporary_folder.h"

namespace arthro {

// Bytes are those of all files together, unpacked. An archive of less than 1 MB must not cost a
// disk or minutes, so above `free_bytes` each byte of the archive gives `most_per_byte` at most;
// pictures and meshes in it give 10.
struct ArchiveLimits {
  std::uint64_t most_bytes = std::uint64_t{4} << 30;
  std::int64_t most_files = 10000;
  std::uint64_t free_bytes = std::uint64_t{64} << 20, most_per_byte = 64;
};

bool IsArchive(const std::filesystem::path& file);  // tests the extension

// scene.json and the files that it names, and nothing else that lies in the folder. Atomic; the
// same scene gives the same bytes. Throws Error(kBadScene) for a scene that cannot be read or is
// not complete, for a file that is not what the scene takes it for, and for a link that leaves the
// folder.
void PackScene(const std::filesystem::path& scene, const std::filesystem::path& archive);

// Into `folder`, which must be there and empty. Throws Error(kBadScene) for anything but a sound
// archive of plain files; what was unpacked until then is left for the owner of the folder.
void UnpackScene(const std::filesystem::path& archive, const std::filesystem::path& folder,
                 const ArchiveLimits& limits = {});

// The same fault, with the archive in place of the folder that it was unpacked into, which is soon
// gone: "s.arthro: scene.json: …".
Error NamedByArchive(const Error& fault, const std::filesystem::path& folder,
                     const std::filesystem::path& archive);

}  // namespace arthro

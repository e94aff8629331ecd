// Files that a person names and the program reads. Only regular files are read: a device or a pipe
// has no end, so reading one would wait for ever or fill the memory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace arthro {

// Largest file of each kind, in bytes. Each is several times the largest file of practice.
inline constexpr std::uint64_t kMostJsonBytes = std::uint64_t{64} << 20;
inline constexpr std::uint64_t kMostTableBytes = std::uint64_t{1} << 30;  // 3 h of two hands
inline constexpr std::uint64_t kMostInputBytes = std::uint64_t{2} << 30;  // pictures, meshes, logs

// Throws Error(kFile) that says what `file` is, unless it is a regular file, or a link to one, that
// can be opened. Call it before a library opens the file by its name.
void RequireRegularFile(const std::filesystem::path& file);

// The first `most_bytes` bytes of a regular file, or fewer where it is shorter. Throws
// Error(kFile).
std::string ReadBeginning(const std::filesystem::path& file, std::size_t most_bytes);

// The whole file. Throws Error(kFile) for one of more than `most_bytes` bytes, for one that cannot
// be read to its end, and where memory does not hold it.
std::string ReadWholeFile(const std::filesystem::path& file, std::uint64_t most_bytes);

}  // namespace arthro

// Files that are either wholly new or untouched: written beside the target, flushed to disk, then
// renamed over it. On any fault the partial file is removed and the old one stays as it was.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace arthro {

// Lets `write` fill a file beside `target` (same extension, so that writers which look at it work),
// then puts it in place. Throws Error(kFile) that says why: missing folder, no permission, disk
// full.
void WriteAtomically(const std::filesystem::path& target,
                     const std::function<void(const std::filesystem::path& beside)>& write);

// The same for bytes already in memory. "-" writes to standard output.
void WriteAtomically(const std::filesystem::path& target, std::string_view bytes);

// What an errno of a failed write means, and what to do.
std::string WhyNotWritten(int error);

// The whole file. Throws Error(kFile).
std::string ReadWholeFile(const std::filesystem::path& file);

}  // namespace arthro

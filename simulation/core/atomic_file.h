// Files that are either wholly new or untouched: written beside the target, flushed to disk, then
// renamed over it. On any fault the partial file is removed and the old one stays as it was.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace arthro {

// Readers of a new file. kShared: whoever the process's umask allows. kPrivate: its owner alone
// (mode 0600), for what identifies a person: logs, films, records.
// A file that is replaced keeps its own mode in either case.
enum class Access { kShared, kPrivate };

// Lets `write` fill a file beside `target` (same extension, so that writers which look at it work),
// then puts it in place. Throws Error(kFile) that says why: missing folder, no permission, disk
// full. A symbolic link stays, and the file that it names is replaced. A read-only file is refused.
void WriteAtomically(const std::filesystem::path& target,
                     const std::function<void(const std::filesystem::path& beside)>& write,
                     Access access = Access::kShared);

// The same for bytes already in memory. "-" writes to standard output.
void WriteAtomically(const std::filesystem::path& target, std::string_view bytes,
                     Access access = Access::kShared);

// A file that takes long to fill, such as a film: fill beside(), then put it in place. One that is
// dropped before is removed.
class PartialFile {
 public:
  // Creates beside(), empty. Throws Error(kFile) where the folder is missing, or where `target` is
  // read-only or something else than a file.
  explicit PartialFile(std::filesystem::path target, Access access = Access::kShared);
  ~PartialFile();
  PartialFile(const PartialFile&) = delete;
  PartialFile& operator=(const PartialFile&) = delete;

  const std::filesystem::path& target() const { return target_; }
  const std::filesystem::path& beside() const { return beside_; }
  // Flushes it to disk and renames it. Throws Error(kFile).
  void PutInPlace();

 private:
  std::filesystem::path target_, place_, beside_;  // place_: target_ with its links followed
  std::optional<unsigned> mode_;                   // to be set at the end; none: as the umask says
  bool is_in_place_ = false;
};

// Meaning of the errno of a failed write, and the remedy.
std::string WhyNotWritten(int error);

// The whole file. Throws Error(kFile).
std::string ReadWholeFile(const std::filesystem::path& file);

}  // namespace arthro

#include "simulation/core/atomic_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>

#include "simulation/core/error.h"

namespace arthro {
namespace {

namespace fs = std::filesystem;

// A name beside the target that no other process is using.
fs::path NameBeside(const fs::path& target) {
  fs::path beside = target;
  beside.replace_filename(fmt::format(".{}.{}.partial{}", target.stem().string(), ::getpid(),
                                      target.extension().string()));
  return beside;
}

fs::path FolderOf(const fs::path& target) {
  return target.has_parent_path() ? target.parent_path() : fs::path(".");
}

// Flushes a file or a folder's entry to disk.
void Sync(const fs::path& path, int flags, const fs::path& target) {
  const int descriptor = ::open(path.c_str(), flags);
  if (descriptor < 0)
    throw Error(Code::kFile, "could not be written: " + WhyNotWritten(errno), target);
  const int result = ::fsync(descriptor);
  const int error = errno;
  ::close(descriptor);
  if (result != 0 && error != EINVAL)  // some file systems cannot sync a folder
    throw Error(Code::kFile, "could not be written: " + WhyNotWritten(error), target);
}

void WriteBytes(const fs::path& file, std::string_view bytes, const fs::path& target) {
  std::FILE* stream = std::fopen(file.c_str(), "wb");
  if (!stream) throw Error(Code::kFile, "could not be written: " + WhyNotWritten(errno), target);
  const bool wrote = std::fwrite(bytes.data(), 1, bytes.size(), stream) == bytes.size();
  int error = errno;
  const bool closed = std::fclose(stream) == 0;
  if (wrote && !closed) error = errno;
  if (!wrote || !closed)
    throw Error(Code::kFile, "could not be written: " + WhyNotWritten(error), target);
}

}  // namespace

std::string WhyNotWritten(int error) {
  if (error == ENOSPC) return "the disk is full; free some space and save again";
  if (error == EFBIG || error == EDQUOT)
    return "no more may be written here; free some space or choose another folder";
  if (error == EACCES || error == EPERM || error == EROFS)
    return "this place may not be written; choose another folder";
  return std::strerror(error);
}

PartialFile::PartialFile(fs::path target) : target_(std::move(target)) {
  const fs::path folder = FolderOf(target_);
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored))
    throw Error(Code::kFile,
                fmt::format("the folder {} does not exist; create it first", folder.string()),
                target_);
  if (fs::exists(target_, ignored) && !fs::is_regular_file(target_, ignored))
    throw Error(Code::kFile,
                fs::is_directory(target_, ignored)
                    ? "this is a folder; give the name of a file"
                    : "this is a device or a pipe; give the name of a file",
                target_);
  beside_ = NameBeside(target_);
}

PartialFile::~PartialFile() {
  std::error_code ignored;
  if (!is_in_place_) fs::remove(beside_, ignored);
}

void PartialFile::PutInPlace() {
  Sync(beside_, O_RDONLY, target_);
  if (::rename(beside_.c_str(), target_.c_str()) != 0)
    throw Error(Code::kFile, "could not be put in place: " + WhyNotWritten(errno), target_);
  is_in_place_ = true;
  Sync(FolderOf(target_), O_RDONLY | O_DIRECTORY, target_);
}

void WriteAtomically(const fs::path& target, const std::function<void(const fs::path&)>& write) {
  std::error_code ignored;
  // Into a device or a pipe as it is: a file in its place would be another thing.
  if (fs::exists(target, ignored) && !fs::is_regular_file(target, ignored) &&
      !fs::is_directory(target, ignored))
    return write(target);
  PartialFile file(target);
  write(file.beside());
  file.PutInPlace();
}

void WriteAtomically(const fs::path& target, std::string_view bytes) {
  if (target == "-") {
    if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size() ||
        std::fflush(stdout) != 0)
      throw Error(Code::kFile, "standard output could not be written: " + WhyNotWritten(errno));
    return;
  }
  WriteAtomically(target, [&](const fs::path& beside) { WriteBytes(beside, bytes, target); });
}

}  // namespace arthro

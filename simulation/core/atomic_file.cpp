#include "simulation/core/atomic_file.h"

#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>

#include "simulation/core/error.h"

namespace arthro {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestStem = 200;  // bytes; file systems take names of 255

// A name beside `place` that no other process is using. It has the ending of `target`, which a link
// and the file that it names need not share.
fs::path NameBeside(const fs::path& place, const fs::path& target) {
  fs::path beside = place;
  beside.replace_filename(fmt::format(".{}.{}.partial{}",
                                      place.stem().string().substr(0, kLongestStem), ::getpid(),
                                      target.extension().string()));
  return beside;
}

// The file that a chain of symbolic links names, which need not exist.
fs::path WithoutLinks(fs::path path, const fs::path& target) {
  constexpr int kMostLinks = 40;  // limit of the kernel
  std::error_code fault;
  for (int i = 0; fs::is_symlink(path, fault); ++i) {
    const fs::path next = fs::read_symlink(path, fault);
    if (fault || i == kMostLinks)
      throw Error(Code::kFile, "this symbolic link cannot be followed; name a file", target);
    path = path.parent_path() / next;  // an absolute `next` replaces all before it
  }
  return path;
}

// Mode of the file that is to be replaced; none where there is no file yet.
std::optional<unsigned> ModeOf(const fs::path& place, const fs::path& target) {
  struct stat found {};
  if (::stat(place.c_str(), &found) != 0) return std::nullopt;
  // Tests the mode bits, since access() tells the superuser that all may be written.
  if ((found.st_mode & S_IWUSR) == 0 || ::access(place.c_str(), W_OK) != 0)
    throw Error(Code::kFile, "this file is read-only; make it writable first or name another file",
                target);
  return found.st_mode & 0777;
}

// Creates an empty file that nobody else has open.
void Create(const fs::path& file, unsigned mode, const fs::path& target) {
  ::unlink(file.c_str());  // left by a dead process of the same number
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
  if (descriptor < 0)
    throw Error(Code::kFile, "could not be written: " + WhyNotWritten(errno), target);
  ::close(descriptor);
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
  return std::generic_category().message(error);
}

PartialFile::PartialFile(fs::path target, Access access)
    : target_(std::move(target)), place_(WithoutLinks(target_, target_)) {
  const fs::path folder = FolderOf(place_);
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored))
    throw Error(Code::kFile,
                fmt::format("the folder {} does not exist; create it first", folder.string()),
                target_);
  if (fs::exists(place_, ignored) && !fs::is_regular_file(place_, ignored))
    throw Error(Code::kFile,
                fs::is_directory(place_, ignored)
                    ? "this is a folder; give the name of a file"
                    : "this is a device or a pipe; give the name of a file",
                target_);
  mode_ = ModeOf(place_, target_);
  if (!mode_ && access == Access::kPrivate) mode_ = S_IRUSR | S_IWUSR;
  beside_ = NameBeside(place_, target_);
  Create(beside_, mode_.value_or(0666), target_);
}

PartialFile::~PartialFile() {
  std::error_code ignored;
  if (!is_in_place_) fs::remove(beside_, ignored);
}

void PartialFile::PutInPlace() {
  // Again, since the umask took from it, and some writers replace the file that they were given.
  if (mode_ && ::chmod(beside_.c_str(), *mode_) != 0)
    throw Error(Code::kFile, "could not be written: " + WhyNotWritten(errno), target_);
  Sync(beside_, O_RDONLY, target_);
  if (::rename(beside_.c_str(), place_.c_str()) != 0)
    throw Error(Code::kFile, "could not be put in place: " + WhyNotWritten(errno), target_);
  is_in_place_ = true;
  Sync(FolderOf(place_), O_RDONLY | O_DIRECTORY, target_);
}

void WriteAtomically(const fs::path& target, const std::function<void(const fs::path&)>& write,
                     Access access) {
  std::error_code ignored;
  // Into a device or a pipe as it is: a file in its place would be another thing.
  if (fs::exists(target, ignored) && !fs::is_regular_file(target, ignored) &&
      !fs::is_directory(target, ignored))
    return write(target);
  PartialFile file(target, access);
  write(file.beside());
  file.PutInPlace();
}

void WriteAtomically(const fs::path& target, std::string_view bytes, Access access) {
  if (target == "-") {
    if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size() ||
        std::fflush(stdout) != 0)
      throw Error(Code::kFile, "standard output could not be written: " + WhyNotWritten(errno));
    return;
  }
  WriteAtomically(
      target, [&](const fs::path& beside) { WriteBytes(beside, bytes, target); }, access);
}

}  // namespace arthro

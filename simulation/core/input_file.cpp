#include "simulation/core/input_file.h"

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <new>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <vector>

#include <fmt/format.h>

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"

namespace arthro {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void RefuseToOpen(int error, const fs::path& file) {
  throw Error(Code::kFile,
              fmt::format("could not be opened: {}; check the name",
                          std::generic_category().message(error)),
              file);
}

void RequireRegular(const struct ::stat& status, const fs::path& file) {
  const char* kind = nullptr;
  switch (status.st_mode & S_IFMT) {
    case S_IFREG:
      return;
    case S_IFDIR:
      throw Error(Code::kFile, "this is a folder; give the name of a file", file);
    case S_IFIFO:
      kind = "a pipe";
      break;
    case S_IFSOCK:
      kind = "a socket";
      break;
    default:
      kind = "a device";
  }
  throw Error(Code::kFile,
              fmt::format("this is {}, which has no end; give the name of a regular file", kind),
              file);
}

// A regular file that is open for reading.
class OpenFile {
 public:
  explicit OpenFile(const fs::path& file) : file_(file) {
    // Asked before it is opened, since opening some devices sets them off.
    struct ::stat status {};
    if (::stat(file.c_str(), &status) != 0) RefuseToOpen(errno, file);
    RequireRegular(status, file);
    // O_NONBLOCK: what became a pipe in between does not hold up the program.
    descriptor_ = ::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    if (descriptor_ < 0) RefuseToOpen(errno, file);
    try {
      if (::fstat(descriptor_, &status) != 0) RefuseToOpen(errno, file);
      RequireRegular(status, file);
    } catch (...) {
      ::close(descriptor_);
      throw;
    }
    size_ = static_cast<std::uint64_t>(std::max<off_t>(status.st_size, 0));
  }
  ~OpenFile() { ::close(descriptor_); }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  std::uint64_t size() const { return size_; }  // 0 for files that the kernel makes up

  // Bytes until `most` are there or the file ends.
  std::string Read(std::uint64_t most) const {
    constexpr std::size_t kPiece = std::size_t{1} << 18;
    std::string bytes;
    bytes.reserve(static_cast<std::size_t>(std::min(most, size_)));
    std::vector<char> piece(kPiece);
    while (bytes.size() < most) {
      const auto wanted = static_cast<std::size_t>(
          std::min<std::uint64_t>(kPiece, most - static_cast<std::uint64_t>(bytes.size())));
      const ssize_t got = ::read(descriptor_, piece.data(), wanted);
      if (got < 0 && errno == EINTR) continue;
      if (got < 0)
        throw Error(Code::kFile,
                    fmt::format("could not be read to its end: {}; copy it to another disk",
                                std::generic_category().message(errno)),
                    file_);
      if (got == 0) break;
      bytes.append(piece.data(), static_cast<std::size_t>(got));
    }
    return bytes;
  }

 private:
  const fs::path& file_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

[[noreturn]] void RefuseSize(std::uint64_t most_bytes, const fs::path& file) {
  throw Error(Code::kFile,
              fmt::format("this file is larger than {} MB, more than the program reads of its "
                          "kind; give a smaller one",
                          most_bytes >> 20),
              file);
}

}  // namespace

void RequireRegularFile(const fs::path& file) { const OpenFile open(file); }

std::string ReadBeginning(const fs::path& file, std::size_t most_bytes) {
  return OpenFile(file).Read(most_bytes);
}

std::string ReadWholeFile(const fs::path& file, std::uint64_t most_bytes) {
  const OpenFile open(file);
  if (open.size() > most_bytes) RefuseSize(most_bytes, file);
  try {
    std::string bytes = open.Read(most_bytes + 1);
    if (bytes.size() > most_bytes) RefuseSize(most_bytes, file);
    if (bytes.size() < open.size())
      throw Error(Code::kFile,
                  fmt::format("ended after {} of {} bytes while it was read; wait until it is "
                              "written and try again",
                              bytes.size(), open.size()),
                  file);
    return bytes;
  } catch (const std::bad_alloc&) {
    throw Error(Code::kFile,
                fmt::format("there is not enough memory for this file of {} MB; close other "
                            "programs or give a smaller one",
                            open.size() >> 20),
                file);
  }
}

std::string ReadWholeFile(const fs::path& file) { return ReadWholeFile(file, kMostInputBytes); }

}  // namespace arthro

#include "simulation/device/log/log_file.h"

#include <cerrno>
#include <fcntl.h>
#include <string>
#include <unistd.h>

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"

namespace arthro::simulation {
namespace {

// Opens the file and returns a descriptor, or -1 and errno.
int Open(const std::filesystem::path& file) {
  constexpr int kFlags = O_WRONLY | O_CREAT | O_CLOEXEC;
  constexpr mode_t kPrivate = 0600;
  const int created = ::open(file.c_str(), kFlags | O_EXCL, kPrivate);
  if (created >= 0 || errno != EEXIST) return created;
  std::error_code ignored;
  if (std::filesystem::is_regular_file(file, ignored) &&
      std::filesystem::file_size(file, ignored) > 0)
    throw Error(Code::kFile, "this file exists and would be lost; name another one", file);
  return ::open(file.c_str(), kFlags | O_TRUNC, kPrivate);
}

}  // namespace

LogFile::LogFile(const std::filesystem::path& file, std::string_view head) : file_(file) {
  descriptor_ = Open(file);
  error_ = descriptor_ < 0 ? errno : 0;
  Write(head);
  if (error_ == 0) return;
  if (descriptor_ >= 0) ::close(descriptor_);
  throw Error(Code::kFile, "could not be written: " + WhyNotWritten(error_), file_);
}

LogFile::~LogFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void LogFile::Write(std::string_view bytes) noexcept {
  while (!bytes.empty() && error_ == 0) {
    const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
    if (count > 0)
      bytes.remove_prefix(static_cast<std::size_t>(count));
    else if (errno != EINTR)
      error_ = errno;
  }
}

void LogFile::Close() {
  if (descriptor_ < 0) return;
  if (::close(descriptor_) != 0 && error_ == 0) error_ = errno;
  descriptor_ = -1;
  if (error_ != 0)
    throw Error(Code::kFile, "could not be written to its end: " + WhyNotWritten(error_), file_);
}

}  // namespace arthro::simulation

#include "simulation/device/live/device_lock.h"

#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace arthro::simulation {
namespace {

std::string FileName(const std::string& device) {
  std::string name = "arthroscene-";
  for (const char c : device)
    name += std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_' ? c : '_';
  return name + ".lock";
}

}  // namespace

std::filesystem::path DeviceLockFolder() {
  const char* runtime = std::getenv("XDG_RUNTIME_DIR");
  std::error_code fault;
  if (runtime && std::filesystem::is_directory(runtime, fault)) return runtime;
  return std::filesystem::temp_directory_path();
}

DeviceLock::DeviceLock(const std::filesystem::path& folder, const std::string& device) {
  const std::filesystem::path path = folder / FileName(device);
  constexpr int kForAll = 0666;
  file_ = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, kForAll);
  // A file of another user in a shared folder can only be read, which is enough to lock it.
  if (file_ < 0) file_ = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file_ < 0) return;
  if (flock(file_, LOCK_EX | LOCK_NB) == 0) {
    const std::string process = std::to_string(getpid()) + "\n";
    // The lock is held even where its process number cannot be written.
    if (ftruncate(file_, 0) == 0 && pwrite(file_, process.data(), process.size(), 0) < 0) errno = 0;
    return;
  }
  is_held_elsewhere_ = errno == EWOULDBLOCK;
  char text[16] = {};
  if (is_held_elsewhere_ && pread(file_, text, sizeof text - 1, 0) > 0) holder_ = std::atoi(text);
  close(file_);
  file_ = -1;
}

DeviceLock::~DeviceLock() {
  if (file_ >= 0) close(file_);
}

}  // namespace arthro::simulation

#include "app/state/scene_lock.h"

#include <ctime>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>

#include "simulation/core/error.h"
#include "simulation/core/input_file.h"
#include "simulation/core/option_fields.h"
#include "simulation/scene/files/archive_io.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;

std::string HostName() {
  char name[256] = "";
  if (::gethostname(name, sizeof name - 1) != 0) return "this computer";
  return name;
}

std::string TimeOfDay() {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  ::localtime_r(&now, &local);
  char words[16];
  std::strftime(words, sizeof words, "%H:%M", &local);
  return words;
}

// Content of the file: who holds the scene.
struct Mark {
  int process = 0;
  std::string host, since;

  template <class V>
  void Visit(V&& v) {
    v("process", process, Any{}, "", "Number of the process.");
    v("host", host, Any{}, "", "Name of its computer.");
    v("since", since, Any{}, "", "Time of day, hours and minutes.");
  }
};

std::string WordsOfMark(const fs::path& file) {
  try {
    Mark mark;
    ReadOptionsText(ReadWholeFile(file, kMostJsonBytes), file, mark);
    return fmt::format("process {} on {} since {}", mark.process, mark.host, mark.since);
  } catch (const std::exception&) {
    return "another process";  // its mark is not written yet
  }
}

// True where the name still stands for the file that was opened.
bool IsStillThere(int file, const fs::path& name) {
  struct stat opened {
  }, named{};
  return ::fstat(file, &opened) == 0 && ::lstat(name.c_str(), &named) == 0 &&
         opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
}

}  // namespace

SceneLock::SceneLock(const fs::path& place) {
  const fs::path file = IsArchive(place)
                            ? place.parent_path() / ("." + place.filename().string() + ".lock")
                            : place / ".scene.lock";
  // Its holder may remove it between the two calls; then there is a new one to lock.
  for (int attempt = 0; attempt < 3; ++attempt) {
    const int lock = ::open(file.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0644);
    if (lock < 0) return;
    if (::flock(lock, LOCK_EX | LOCK_NB) != 0) {
      if (errno == EWOULDBLOCK) other_ = WordsOfMark(file);
      ::close(lock);
      return;
    }
    if (!IsStillThere(lock, file)) {
      ::close(lock);
      continue;
    }
    const std::string mark =
        OptionsText(Mark{static_cast<int>(::getpid()), HostName(), TimeOfDay()}) + "\n";
    if (::ftruncate(lock, 0) != 0 ||
        ::pwrite(lock, mark.data(), mark.size(), 0) != static_cast<ssize_t>(mark.size())) {
      // A full disk: the lock counts, its words are missing.
    }
    file_ = file;
    lock_ = lock;
    return;
  }
}

SceneLock::~SceneLock() {
  if (lock_ < 0) return;
  std::error_code ignored;
  fs::remove(file_, ignored);
  ::close(lock_);
}

SceneLock::SceneLock(SceneLock&& other) noexcept
    : file_(std::move(other.file_)),
      other_(std::move(other.other_)),
      lock_(std::exchange(other.lock_, -1)) {}

SceneLock& SceneLock::operator=(SceneLock&& other) noexcept {
  std::swap(file_, other.file_);
  std::swap(other_, other.other_);
  std::swap(lock_, other.lock_);
  return *this;
}

}  // namespace arthro::app

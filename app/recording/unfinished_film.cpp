#include "app/recording/unfinished_film.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <optional>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kWord = ".recording";
constexpr std::size_t kLongestStem = 200;  // bytes; a name has 255
constexpr off_t kHeadOnly = 1 << 16;       // bytes; a film without a whole picture is not larger
constexpr int kMostNames = 10000;

// A descriptor that closes itself.
class Descriptor {
 public:
  explicit Descriptor(int own) : own_(own) {}
  ~Descriptor() {
    if (own_ >= 0) ::close(own_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return own_; }

 private:
  int own_;
};

struct RecordingName {
  std::string stem, ending;
  pid_t process = 0;
};

// Parts of .STEM.PID.recording.EXT; the STEM may hold points.
std::optional<RecordingName> ParseName(const fs::path& file) {
  const std::string ending = file.extension().string();
  std::string rest = file.stem().string();
  if (!FilmFormatOf(file) || !rest.starts_with('.') || !rest.ends_with(kWord)) return std::nullopt;
  rest = rest.substr(1, rest.size() - 1 - kWord.size());
  const std::size_t point = rest.rfind('.');
  if (point == std::string::npos || point == 0) return std::nullopt;
  const std::string digits = rest.substr(point + 1);
  if (digits.empty() || digits.size() > 9 ||
      digits.find_first_not_of("0123456789") != std::string::npos)
    return std::nullopt;
  return RecordingName{rest.substr(0, point), ending, std::stoi(digits)};
}

// False: another program has it. Where the file system has no locks the process's number tells.
bool Lock(int descriptor, pid_t process) {
  if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return true;
  if (errno == EWOULDBLOCK) return false;
  return ::kill(process, 0) != 0 && errno == ESRCH;
}

[[noreturn]] void Refuse(int error, const fs::path& file) {
  throw Error(Code::kFile, "could not be written: " + WhyNotWritten(error), file);
}

// Renames `file` to `target`, or to the first free name with -recovered where that is taken.
fs::path PlaceWithoutReplacing(const fs::path& file, const fs::path& target, bool is_taken) {
  for (int i = is_taken ? 1 : 0; i < kMostNames; ++i) {
    fs::path place = target;
    if (i > 0)
      place.replace_filename(fmt::format("{}-recovered{}{}", target.stem().string(),
                                         i > 1 ? fmt::format("-{}", i) : "",
                                         target.extension().string()));
    // Reserves the name, so that nothing of anybody else's is replaced.
    const Descriptor reserved(::open(place.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600));
    if (reserved.get() < 0 && errno == EEXIST) continue;
    if (reserved.get() < 0) Refuse(errno, place);
    if (::rename(file.c_str(), place.c_str()) == 0) return place;
    const int error = errno;
    ::unlink(place.c_str());
    Refuse(error, place);
  }
  Refuse(EEXIST, target);
}

struct Placed {
  fs::path file;  // empty: it has no whole picture
  double seconds = 0;
};

// An ordinary film of the whole pictures, or the recording itself where there is no room for one.
Placed PutInPlace(int descriptor, const fs::path& beside, const fs::path& target, bool is_taken) {
  const FilmFormat format = *FilmFormatOf(target);
  const auto content = ReadFilmContent(descriptor, format);
  if (!content || content->pictures == 0) return {};
  Placed placed;
  placed.seconds = content->pictures / content->rate;

  fs::path copy = target;
  copy.replace_filename(fmt::format(".{}-recovered.{}.partial{}",
                                    target.stem().string().substr(0, kLongestStem), ::getpid(),
                                    target.extension().string()));
  ::unlink(copy.c_str());  // left by a dead process with this number
  {
    const Descriptor to(::open(copy.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600));
    int copied = 0;
    bool is_whole = to.get() >= 0 && CopyFilm(descriptor, format, to.get(), copied).is_good &&
                    copied == content->pictures && ::fsync(to.get()) == 0;
    if (is_whole) {
      const auto read_back = ReadFilmContent(to.get(), format);
      is_whole = read_back && read_back->pictures == copied;
    }
    if (!is_whole) {
      ::unlink(copy.c_str());
      copy.clear();
    }
  }
  if (copy.empty()) {
    placed.file = PlaceWithoutReplacing(beside, target, is_taken);
    return placed;
  }
  try {
    placed.file = PlaceWithoutReplacing(copy, target, is_taken);
  } catch (const Error&) {
    ::unlink(copy.c_str());
    throw;
  }
  ::unlink(beside.c_str());
  return placed;
}

bool IsSameName(const fs::path& a, const fs::path& b) {
  std::error_code ignored;
  return !b.empty() && fs::weakly_canonical(fs::absolute(a), ignored) ==
                           fs::weakly_canonical(fs::absolute(b), ignored);
}

// Empty: another program has it, or has finished it.
std::string FinishOne(const fs::path& file, const RecordingName& name, const fs::path& wanted) {
  const Descriptor own(::open(file.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  struct stat status {};
  if (own.get() < 0 || !Lock(own.get(), name.process) || ::fstat(own.get(), &status) != 0 ||
      !S_ISREG(status.st_mode) || status.st_uid != ::geteuid() || status.st_nlink == 0)
    return "";
  fs::path target = file;
  target.replace_filename(name.stem + name.ending);
  try {
    const Placed placed = PutInPlace(own.get(), file, target, IsSameName(target, wanted));
    if (!placed.file.empty())
      return fmt::format(
          "{}: the program ended while {} was recorded; its first {:.1f} s were saved here",
          placed.file.string(), target.filename().string(), placed.seconds);
    if (status.st_size > kHeadOnly)
      return fmt::format("{}: this recording cannot be read as a film; look at it, then remove it",
                         file.string());
    ::unlink(file.c_str());
    return fmt::format("{}: the program ended before this recording had a picture; it was removed",
                       target.string());
  } catch (const Error& error) {
    return fmt::format("{}: this recording could not be put in place: {}", file.string(),
                       error.sentence());
  }
}

fs::path RecordingsFile() {
  const char* state = std::getenv("XDG_STATE_HOME");
  if (state && *state) return fs::path(state) / "arthroscene" / "recordings";
  const char* home = std::getenv("HOME");
  return home && *home ? fs::path(home) / ".local" / "state" / "arthroscene" / "recordings"
                       : fs::path();
}

bool HasRecordings(const fs::path& folder) {
  std::error_code fault;
  for (fs::directory_iterator at(folder, fault), end; !fault && at != end; at.increment(fault))
    if (ParseName(at->path().filename())) return true;
  return false;
}

}  // namespace

UnfinishedFilm::UnfinishedFilm(const fs::path& target) : target_(target) {
  // Refuses what cannot be a film's place, and knows the folder behind a link.
  const fs::path folder = PartialFile(target, Access::kPrivate).beside().parent_path();
  beside_ = folder / fmt::format(".{}.{}{}{}", target.stem().string().substr(0, kLongestStem),
                                 ::getpid(), kWord, target.extension().string());
  // One of a dead process with this number.
  if (const auto name = ParseName(beside_.filename())) FinishOne(beside_, *name, target);
  // Another program may find it before it is locked, and remove it as one that holds nothing.
  for (bool is_there = false; !is_there;) {
    descriptor_ = ::open(beside_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600);
    if (descriptor_ < 0 && errno == EEXIST)
      throw Error(Code::kFile, "a film is being recorded there already; name another file", target);
    if (descriptor_ < 0) Refuse(errno, target);
    while (::flock(descriptor_, LOCK_EX) != 0 && errno == EINTR) {
    }
    struct stat status {};
    is_there = ::fstat(descriptor_, &status) != 0 || status.st_nlink > 0;
    if (!is_there) ::close(descriptor_);
  }
}

UnfinishedFilm::~UnfinishedFilm() {
  if (!is_kept_) Remove();
  ::close(descriptor_);
}

void UnfinishedFilm::Remove() {
  is_kept_ = true;
  ::unlink(beside_.c_str());
}

fs::path UnfinishedFilm::PutWholeInPlace(off_t bytes) {
  is_kept_ = true;
  if (::ftruncate(descriptor_, bytes) != 0) Refuse(errno, target_);
  return PutInPlace(descriptor_, beside_, target_, false).file;
}

std::vector<std::string> FinishFilmsIn(const fs::path& folder, const fs::path& wanted) {
  std::vector<fs::path> found;
  std::error_code fault;
  const fs::path plain = folder.empty() ? fs::path(".") : folder;
  for (fs::directory_iterator at(plain, fault), end; !fault && at != end; at.increment(fault))
    if (ParseName(at->path().filename())) found.push_back(at->path());
  std::ranges::sort(found);
  std::vector<std::string> sentences;
  for (const fs::path& file : found)
    if (std::string sentence = FinishOne(file, *ParseName(file.filename()), wanted);
        !sentence.empty())
      sentences.push_back(std::move(sentence));
  return sentences;
}

void NoteRecordingFolder(const fs::path& folder) {
  const fs::path list = RecordingsFile();
  std::error_code fault;
  const fs::path whole = fs::weakly_canonical(folder.empty() ? fs::path(".") : folder, fault);
  if (list.empty() || fault || whole.string().find('\n') != std::string::npos) return;
  fs::create_directories(list.parent_path(), fault);
  // One write, so that two programs do not mix their lines.
  const Descriptor own(::open(list.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600));
  const std::string line = whole.string() + "\n";
  if (own.get() < 0 || ::flock(own.get(), LOCK_SH | LOCK_NB) != 0) return;
  [[maybe_unused]] const ssize_t count = ::write(own.get(), line.data(), line.size());
}

std::vector<std::string> FinishFilmsEverywhere(const fs::path& wanted) {
  std::vector<std::string> sentences;
  if (!wanted.empty()) sentences = FinishFilmsIn(wanted.parent_path(), wanted);
  const fs::path list = RecordingsFile();
  if (list.empty()) return sentences;
  const Descriptor own(::open(list.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC));
  struct stat status {};
  if (own.get() < 0 || ::fstat(own.get(), &status) != 0 || !S_ISREG(status.st_mode) ||
      ::flock(own.get(), LOCK_EX | LOCK_NB) != 0)
    return sentences;
  constexpr std::size_t kLongest = 1 << 20;  // bytes
  std::string text(std::min<std::size_t>(static_cast<std::size_t>(status.st_size), kLongest), '\0');
  const ssize_t read = ::pread(own.get(), text.data(), text.size(), 0);
  text.resize(static_cast<std::size_t>(std::max<ssize_t>(read, 0)));
  std::vector<std::string> folders;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    if (end > at) folders.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  std::ranges::sort(folders);
  folders.erase(std::unique(folders.begin(), folders.end()), folders.end());
  std::string still;
  for (const std::string& folder : folders) {
    for (std::string& sentence : FinishFilmsIn(folder, wanted))
      sentences.push_back(std::move(sentence));
    if (HasRecordings(folder)) still += folder + "\n";
  }
  if (still == text) return sentences;
  if (::ftruncate(own.get(), 0) == 0) {
    [[maybe_unused]] const ssize_t count = ::pwrite(own.get(), still.data(), still.size(), 0);
  }
  return sentences;
}

}  // namespace arthro::app

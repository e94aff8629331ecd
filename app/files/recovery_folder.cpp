#include "app/files/recovery_folder.h"

#include <algorithm>
#include <cstdlib>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "simulation/core/error.h"
#include "simulation/core/input_file.h"
#include "simulation/core/json_text.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSchema = "arthroscene.recovery/2";
constexpr const char* kEarlierSchema = "arthroscene.recovery/1";
constexpr std::time_t kYoung = 60;  // s; a folder of that age may be about to get its copy

std::time_t TimeOf(const fs::path& file) {
  struct stat status {};
  return ::stat(file.c_str(), &status) == 0 ? status.st_mtime : 0;
}

}  // namespace

std::string WordsOfTime(std::time_t time) {
  std::tm local{};
  ::localtime_r(&time, &local);
  char words[64];
  std::strftime(words, sizeof words, "%d %b, %H:%M:%S", &local);
  return words;
}

fs::path RecoveryFolder() {
  const fs::path below = fs::path("arthroscene") / "recovery";
  const char* state = std::getenv("XDG_STATE_HOME");
  if (state != nullptr && *state != '\0') return fs::path(state) / below;
  const char* home = std::getenv("HOME");
  return home != nullptr && *home != '\0' ? fs::path(home) / ".local" / "state" / below
                                          : fs::path();
}

RecoverySession::~RecoverySession() {
  if (lock_ >= 0) ::close(lock_);
}

RecoverySession::RecoverySession(RecoverySession&& other) noexcept
    : folder_(std::move(other.folder_)), lock_(std::exchange(other.lock_, -1)) {}

RecoverySession& RecoverySession::operator=(RecoverySession&& other) noexcept {
  std::swap(folder_, other.folder_);
  std::swap(lock_, other.lock_);
  return *this;
}

RecoverySession RecoverySession::Lock(const fs::path& folder) {
  RecoverySession session;
  const int lock = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (lock < 0) return session;
  struct stat status {};
  std::error_code ignored;
  if (::fstat(lock, &status) != 0 || status.st_uid != ::geteuid() ||
      ::flock(lock, LOCK_EX | LOCK_NB) != 0 || !fs::exists(folder, ignored)) {
    ::close(lock);
    return session;
  }
  session.folder_ = folder;
  session.lock_ = lock;
  return session;
}

RecoverySession RecoverySession::Create(const fs::path& parent) {
  std::error_code error;
  fs::create_directories(parent, error);
  if (!error) fs::permissions(parent, fs::perms::owner_all, error);
  std::string name = (parent / "session-XXXXXX").string();
  if (error || ::mkdtemp(name.data()) == nullptr)  // makes it with mode 0700
    throw Error(Code::kFile, "no recovery copy can be kept in this folder; save often", parent);
  RecoverySession session = Lock(name);
  if (!session.is_open())
    throw Error(Code::kFile, "this folder cannot be locked for a recovery copy; save often", name);
  return session;
}

std::vector<RecoverySession> RecoverySession::Left(const fs::path& parent) {
  std::vector<RecoverySession> left;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(parent, ignored)) {
    if (!entry.path().filename().string().starts_with("session-")) continue;
    RecoverySession session = Lock(entry.path());
    if (!session.is_open()) continue;
    if (session.time_of_copy() != 0)
      left.push_back(std::move(session));
    else if (std::time(nullptr) - TimeOf(entry.path()) > kYoung)
      session.Remove();
  }
  std::sort(left.begin(), left.end(), [](const RecoverySession& a, const RecoverySession& b) {
    return a.time_of_copy() > b.time_of_copy();
  });
  return left;
}

fs::path RecoverySession::copy() const {
  const fs::path earlier = folder_ / "scene.arthro";
  std::error_code ignored;
  return fs::exists(earlier, ignored) ? earlier : scene_folder() / "scene.json";
}

std::time_t RecoverySession::time_of_copy() const { return TimeOf(copy()); }

void RecoverySession::Retire() {
  std::error_code ignored;
  if (is_open()) fs::remove(copy(), ignored);
}

void RecoverySession::Remove() {
  if (!is_open()) return;
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
  ::close(std::exchange(lock_, -1));
}

RecoveryNote RecoverySession::ReadNote() const {
  RecoveryNote note;
  try {
    const bool is_earlier = copy().filename() == "scene.arthro";
    const fs::path file = is_earlier ? folder_ / "about.json" : copy();
    auto json = ParseJson(ReadWholeFile(file, kMostJsonBytes), Code::kBadData, file);
    if (!is_earlier) json = json.at(kRecoveryKey);
    if (const auto schema = json.at("schema").get<std::string>();
        schema != kSchema && schema != kEarlierSchema) {
      note.problem = fmt::format(
          "Another version of the program left this copy ({}). That version restores it from {}.",
          schema, folder_.string());
      return note;
    }
    note.title = json.at("title").get<std::string>();
    note.folder = json.at("folder").get<std::string>();
    note.edits = json.value("edits", 0);
    note.last_edit = json.value("last_edit", "");
    note.is_depth_pending = json.value("depth_pending", false);
  } catch (const std::exception&) {
    note.problem = fmt::format(
        "The copy is damaged and cannot be restored. Its pictures and surfaces lie in {}.",
        folder_.string());
  }
  return note;
}

std::string JsonFromRecoveryNote(const RecoveryNote& note) {
  const nlohmann::json json = {{"schema", kSchema},
                               {"title", note.title},
                               {"folder", note.folder.string()},
                               {"edits", note.edits},
                               {"last_edit", note.last_edit},
                               {"depth_pending", note.is_depth_pending}};
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace arthro::app

#include "simulation/core/folders/leftovers.h"

#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdlib>
#include <ctime>
#include <optional>
#include <string>
#include <string_view>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"

namespace arthro {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kTemporary = "arthroscene-";
constexpr std::string_view kPartial = ".partial";

// A whole number of a process, nothing else beside it.
std::optional<pid_t> Process(std::string_view digits) {
  int number = 0;
  const auto [end, fault] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (fault != std::errc() || end != digits.data() + digits.size() || number < 2)
    return std::nullopt;
  return number;
}

// The process of ".STEM.PID.partial", alone or before a dot and anything else: libraries append
// endings of their own.
std::optional<pid_t> ProcessOfPartial(std::string_view name) {
  if (name.empty() || name.front() != '.') return std::nullopt;
  const std::size_t mark = name.rfind(kPartial);
  if (mark == std::string_view::npos) return std::nullopt;
  const std::string_view after = name.substr(mark + kPartial.size());
  if (!after.empty() && after.front() != '.') return std::nullopt;
  const std::string_view before = name.substr(0, mark);
  const std::size_t dot = before.rfind('.');
  if (dot == 0 || dot == std::string_view::npos) return std::nullopt;
  return Process(before.substr(dot + 1));
}

// The process of "arthroscene-PID-XXXXXX".
std::optional<pid_t> ProcessOfTemporary(std::string_view name) {
  constexpr std::size_t kRandom = 6;
  if (!name.starts_with(kTemporary)) return std::nullopt;
  name.remove_prefix(kTemporary.size());
  const std::size_t dash = name.find('-');
  if (dash == std::string_view::npos || name.size() - dash - 1 != kRandom) return std::nullopt;
  return Process(name.substr(0, dash));
}

bool IsDead(pid_t process) { return ::kill(process, 0) != 0 && errno == ESRCH; }

// Removes the entries of `folder` whose name, by `process_of`, tells a process that is dead.
template <class ProcessOf>
void Remove(const fs::path& folder, const ProcessOf& process_of, bool folders_only,
            std::chrono::seconds least_age) noexcept {
  try {
    const std::time_t now = std::time(nullptr);
    for (const fs::directory_entry& entry : fs::directory_iterator(folder.empty() ? "." : folder)) {
      const std::optional<pid_t> process = process_of(entry.path().filename().string());
      if (!process || !IsDead(*process)) continue;
      struct stat found {};
      if (::lstat(entry.path().c_str(), &found) != 0 || found.st_uid != ::geteuid() ||
          now - found.st_mtime < least_age.count())
        continue;
      std::error_code ignored;
      if (S_ISDIR(found.st_mode))
        fs::remove_all(entry.path(), ignored);  // follows no link
      else if (S_ISREG(found.st_mode) && !folders_only)
        fs::remove(entry.path(), ignored);
    }
  } catch (const std::exception&) {  // a folder that cannot be read keeps what it holds
  }
}

}  // namespace

void RemoveLeftovers(const fs::path& folder, std::chrono::seconds least_age) noexcept {
  Remove(folder, ProcessOfPartial, false, least_age);
}

fs::path MakeTemporaryFolder() {
  std::error_code fault;
  const fs::path above = fs::temp_directory_path(fault);
  if (fault)
    throw Error(Code::kFile,
                "there is no folder for temporary files; set TMPDIR to one that may be written");
  Remove(above, ProcessOfTemporary, true, kLeastLeftoverAge);
  std::string name = (above / fmt::format("{}{}-XXXXXX", kTemporary, ::getpid())).string();
  if (::mkdtemp(name.data()) == nullptr)
    throw Error(Code::kFile,
                fmt::format("no temporary folder can be made: {}; set TMPDIR to another place",
                            WhyNotWritten(errno)),
                above);
  return name;
}

}  // namespace arthro

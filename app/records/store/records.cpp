#include "app/records/store/records.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <sys/random.h>
#include <unistd.h>

#include <fmt/format.h>

#include "app/records/store/schema.h"
#include "simulation/core/error.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;

RecordsOptions Completed(RecordsOptions options) {
  if (options.station.empty()) options.station = StationName();
  if (!options.now) options.now = UtcNow;
  return options;
}

// Returns the connection. Refuses an empty file beside logs of attempts: something has emptied it,
// and new tables in it would hide that. Logs of the outbox wait for their first records.
const std::string& NotEmptied(const std::string& connection, const fs::path& folder) {
  std::error_code ignored;
  if (IsServer(connection) || !fs::is_regular_file(connection, ignored) ||
      fs::file_size(connection, ignored) > 0)
    return connection;
  const auto is_log = [&](const fs::directory_entry& entry) {
    return entry.path().extension() == ".attempt" &&
           !fs::exists(folder / "outbox" / (entry.path().stem().string() + ".json"), ignored);
  };
  const auto logs = std::ranges::count_if(fs::directory_iterator(folder / "attempts", ignored),
                                          fs::directory_iterator(), is_log);
  if (logs > 0)
    throw Error(Code::kBadData,
                fmt::format("the records are empty, though {} attempts lie beside them; restore a "
                            "backup, or remove the empty file to begin anew",
                            logs),
                connection);
  return connection;
}

}  // namespace

Records::Records(const std::string& connection, RecordsOptions options)
    : options_(Completed(std::move(options))),
      folder_(options_.folder.empty() ? RecordsFolder(connection) : options_.folder),
      database_(NotEmptied(connection, folder_), options_.timeout),
      random_(options_.seed ? Random(*options_.seed) : RandomFromSystem()) {
  copy_ = Migrate(database_, EveryMigration());
}

std::string Records::NewId() { return UuidOf(random_); }
std::string Records::Now() const { return options_.now(); }

std::string DefaultRecords() {
  const char* data = std::getenv("XDG_DATA_HOME");
  if (data && *data) return (fs::path(data) / "arthroscene" / "records.sqlite").string();
  const char* home = std::getenv("HOME");
  if (home && *home)
    return (fs::path(home) / ".local" / "share" / "arthroscene" / "records.sqlite").string();
  throw Error(Code::kFile,
              "there is no home folder for the records; name their place with --records");
}

fs::path RecordsFolder(const std::string& connection) {
  const fs::path file = IsServer(connection) ? DefaultRecords() : connection;
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

std::string StationName() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

std::string UuidOf(Random& random) {
  const std::uint64_t a = random.Next(), b = random.Next();
  return fmt::format("{:08x}-{:04x}-4{:03x}-{:04x}-{:012x}", a >> 32, (a >> 16) & 0xffff, a & 0xfff,
                     0x8000 | (b >> 48 & 0x3fff), b & 0xffffffffffff);
}

Random RandomFromSystem() {
  std::uint64_t seed = 0;
  if (::getrandom(&seed, sizeof seed, 0) != sizeof seed)
    throw Error(Code::kFile, "the system gives no random numbers; start it anew");
  return Random(seed);
}

}  // namespace arthro::app

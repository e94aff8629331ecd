// The records of trainees and their attempts: a database, the folder of its files, and sources of
// time and of ids. What is stored in it: attempts/attempt_record.h and people/.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "app/records/store/database.h"
#include "app/records/store/utc_time.h"
#include "simulation/core/random.h"

namespace arthro::app {

struct RecordsOptions {
  std::string station;                // name of this machine; empty: the system's
  double timeout = 10;                // s, for another writer or a server
  std::optional<std::uint64_t> seed;  // start of the ids, so that tests repeat; none: random
  std::function<std::string()> now;   // UTC; empty: the system's clock
  // Files of attempts and the outbox; empty: RecordsFolder(connection).
  std::filesystem::path folder;
};

class Records {
 public:
  // `connection`: as Database takes it. Makes or migrates the tables. Throws Error.
  explicit Records(const std::string& connection, RecordsOptions options = {});

  Database& database() { return database_; }
  const std::filesystem::path& folder() const { return folder_; }
  const std::string& station() const { return options_.station; }
  // The copy that was made before a migration; empty without one.
  const std::filesystem::path& copy() const { return copy_; }
  std::string NewId();  // a random UUID [RFC 4122, version 4]
  std::string Now() const;

 private:
  RecordsOptions options_;
  std::filesystem::path folder_, copy_;
  Database database_;
  Random random_;
};

// The records of this user: $XDG_DATA_HOME/arthroscene/records.sqlite, below ~/.local/share where
// that is not set. Throws Error(kFile) without a home.
std::string DefaultRecords();
// The folder of a database file, or that of DefaultRecords for a server.
std::filesystem::path RecordsFolder(const std::string& connection);

std::string StationName();           // name of this machine
std::string UuidOf(Random& random);  // version 4
Random RandomFromSystem();           // starts at a number of the system's random source

}  // namespace arthro::app

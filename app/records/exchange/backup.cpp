#include "app/records/exchange/backup.h"

#include <system_error>

#include <fmt/format.h>

#include "app/records/attempts/outbox.h"
#include "app/records/store/schema.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;

long CountOf(Database& database, const std::string& table) {
  return static_cast<long>(
      WholeOf(database.Ask("SELECT CAST(count(*) AS BIGINT) FROM " + table).at(0).at(0)));
}

}  // namespace

void Backup(Records& records, const fs::path& file, bool replaces) {
  if (records.database().kind() == DatabaseKind::kPostgresql)
    throw Error(
        Code::kBadArgument,
        fmt::format("these records lie on a server; copy them there: pg_dump --format=custom "
                    "--file={} {}",
                    file.string(), records.database().words()));
  std::error_code ignored;
  if (!replaces && fs::exists(file, ignored))
    throw Error(Code::kFile, "this file exists, and a backup is not written over it; name another",
                file);
  // The copy takes the place of a private file, so that nobody reads it while it grows.
  PartialFile partial(file, Access::kPrivate);
  records.database().Do("VACUUM INTO :file", {{partial.beside().string()}});
  partial.PutInPlace();
}

RecordsCheck CheckRecords(Records& records) {
  Database& database = records.database();
  RecordsCheck check;
  check.schema = SchemaOf(database);
  if (database.kind() == DatabaseKind::kSqlite) {
    for (const Row& row : database.Ask("PRAGMA integrity_check"))
      if (TextOf(row[0]) != "ok")
        check.faults.push_back(
            fmt::format("the database is damaged: {}; restore a backup", TextOf(row[0])));
    for (const Row& row : database.Ask("PRAGMA foreign_key_check"))
      check.faults.push_back(fmt::format("a row of {} names a row of {} that is not there",
                                         TextOf(row[0]), TextOf(row[2])));
  }
  check.trainees = CountOf(database, "trainees");
  check.attempts = CountOf(database, "attempts");
  check.running = CountOf(database, "attempts WHERE outcome = 'running'");
  std::error_code fault;
  for (const auto& entry : fs::directory_iterator(OutboxOf(records.folder()), fault))
    check.outbox += entry.path().extension() == ".json";
  for (const Row& row : database.Ask(
           "SELECT attempts.log, attempts.log_bytes FROM attempts JOIN sessions ON sessions.id = "
           "attempts.session WHERE sessions.station = :station AND attempts.log_bytes IS NOT NULL "
           "ORDER BY attempts.log",
           {records.station()})) {
    const fs::path file = records.folder() / TextOf(row[0]);
    const auto size = fs::file_size(file, fault);
    if (fault)
      check.faults.push_back(fmt::format("the file of an attempt is not there: {}", file.string()));
    else if (static_cast<std::int64_t>(size) != WholeOf(row[1]))
      check.faults.push_back(fmt::format("the file of an attempt has {} bytes instead of {}: {}",
                                         size, WholeOf(row[1]), file.string()));
  }
  return check;
}

}  // namespace arthro::app

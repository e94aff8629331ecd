// Copies and checks of the records.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/records/store/records.h"

namespace arthro::app {

// Copies an SQLite database, whole and as of one moment, for its owner alone. Throws Error: the
// file exists and is not to be replaced, or the records lie on a server, which pg_dump copies.
void Backup(Records& records, const std::filesystem::path& file, bool replaces = false);

struct RecordsCheck {
  int schema = 0;
  long trainees = 0, attempts = 0, running = 0, outbox = 0;
  std::vector<std::string> faults;  // sentences
};
// Reads the whole database: its integrity, its references, and the files of this station's
// attempts.
RecordsCheck CheckRecords(Records& records);

}  // namespace arthro::app

// Attempts that could not be written to their database, one file each, until the database is
// reached again.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/records/attempts/attempt_record.h"
#include "app/records/store/records.h"

namespace arthro::app {

// The folder of the outbox in a folder of records.
std::filesystem::path OutboxOf(const std::filesystem::path& folder);

// Writes a bundle of one attempt, for its owner alone. Throws Error(kFile).
std::filesystem::path KeepInOutbox(const std::filesystem::path& folder,
                                   const RecordsBundle& bundle);

// A bundle for an attempt that begins while no database is reached: the trainee is known by a code.
RecordsBundle StartInOutbox(Random& random, const std::string& trainee_code,
                            const SessionRow& session, const ExerciseRow& exercise,
                            const std::string& started, AttemptMode mode);

// Writes an attempt that is over into the records, or into the outbox where these refuse it; null:
// there are none. Returns "" for the records, else a sentence that says where the attempt is.
// Throws Error only where both fail: the caller then still has the attempt.
std::string FinishOrKeep(Records* records, const std::filesystem::path& folder,
                         const RecordsBundle& bundle);

struct Synced {
  int fresh = 0, known = 0;
  std::vector<std::string> refused;  // a sentence per file that stays
};
// Moves the attempts of an outbox into the records. A file is removed after its attempt is there.
Synced SyncOutbox(Records& records, const std::filesystem::path& folder);

}  // namespace arthro::app

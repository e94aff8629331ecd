// Attempts that could not be written to their database, one file each, until the database is
// reached again. Where the folder of the records cannot be written either, logs and outbox go to a
// spare folder of this user, from which they come back like the others.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/records/attempts/attempt_record.h"
#include "app/records/store/records.h"

namespace arthro::app {

// The folder of the outbox in a folder of records.
std::filesystem::path OutboxOf(const std::filesystem::path& folder);

// Spare folder for that of some records, below the records of this user. Empty where it would be
// the same one, or without a home.
std::filesystem::path SpareFolder(const std::filesystem::path& folder);
// The folder itself, or its spare where no attempt can be written to it.
std::filesystem::path FolderToWrite(const std::filesystem::path& folder);

// Writes a bundle of one attempt, for its owner alone, to the folder or its spare. Throws
// Error(kFile).
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
// Moves the attempts of the folder's outbox and of its spare into the records. A file is removed
// after its attempt is there. An attempt that the records refuse stays, and the others go on.
Synced SyncOutbox(Records& records, const std::filesystem::path& folder);

}  // namespace arthro::app

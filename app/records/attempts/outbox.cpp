#include "app/records/attempts/outbox.h"

#include <algorithm>
#include <system_error>
#include <unistd.h>

#include <fmt/format.h>

#include "app/records/attempts/attempts.h"
#include "app/records/attempts/records_file.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/core/sha256.h"

namespace arthro::app {

namespace fs = std::filesystem;

fs::path OutboxOf(const fs::path& folder) { return folder / "outbox"; }

fs::path SpareFolder(const fs::path& folder) {
  constexpr std::size_t kDigits = 16;
  try {
    const fs::path own = RecordsFolder(DefaultRecords());
    std::error_code ignored;
    const fs::path place = fs::weakly_canonical(folder, ignored);
    const fs::path home = fs::weakly_canonical(own, ignored);
    if (place.empty() || place == home || place.parent_path() == home / "spare") return {};
    return home / "spare" / Sha256(place.string()).substr(0, kDigits);
  } catch (const Error&) {  // no home
    return {};
  }
}

fs::path FolderToWrite(const fs::path& folder) {
  std::error_code ignored;
  for (const char* part : {"", "attempts", "outbox", "running"})
    if (const fs::path own = folder / part;
        fs::exists(own, ignored) && ::access(own.c_str(), W_OK | X_OK) != 0)
      if (fs::path spare = SpareFolder(folder);
          !spare.empty() && (fs::create_directories(spare, ignored) || fs::exists(spare, ignored)))
        return spare;
  return folder;
}

namespace {

fs::path WriteToOutbox(const fs::path& folder, const RecordsBundle& bundle) {
  std::error_code fault;
  fs::create_directories(OutboxOf(folder), fault);
  if (fault)
    throw Error(Code::kFile, "the outbox could not be made: " + WhyNotWritten(fault.value()),
                OutboxOf(folder));
  fs::path file = OutboxOf(folder) / (bundle.attempts.at(0).id + ".json");
  WriteAtomically(file, RecordsText(bundle), Access::kPrivate);
  return file;
}

// Files of a folder with this ending, in their order.
std::vector<fs::path> FilesIn(const fs::path& folder, const char* ending) {
  std::vector<fs::path> files;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (entry.path().extension() == ending && entry.path().filename().string()[0] != '.')
      files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

// Brings the logs of attempts that are over from the spare folder to that of the records.
void BringLogs(const fs::path& spare, const fs::path& folder) {
  for (const fs::path& log : FilesIn(spare / "attempts", ".attempt")) {
    const std::string attempt = log.stem().string();
    std::error_code fault;
    if (fs::exists(OutboxOf(spare) / (attempt + ".json"), fault)) continue;
    const AttemptMark mark(spare, attempt);
    if (!mark.is_held()) continue;  // it runs, and its log grows
    fs::create_directories(folder / "attempts", fault);
    fs::copy_file(log, folder / LogNameOf(attempt), fs::copy_options::overwrite_existing, fault);
    if (!fault) fs::remove(log, fault);
  }
}

// `is_spare`: the folder is not that of the records.
void Sync(Records& records, const fs::path& folder, bool is_spare, Synced& synced) {
  std::error_code fault;
  for (const fs::path& file : FilesIn(OutboxOf(folder), ".json")) try {
      const RecordsBundle bundle = RecordsFromText(ReadWholeFile(file), file);
      if (bundle.attempts.size() != 1)
        throw Error(Code::kBadData,
                    fmt::format("this file of the outbox has {} attempts instead of one; take it "
                                "in by `arthroscene records import`",
                                bundle.attempts.size()),
                    file);
      const AttemptMark mark =
          is_spare ? AttemptMark(folder, bundle.attempts.at(0).id) : AttemptMark();
      if (is_spare && !mark.is_held()) continue;  // it runs
      const Imported imported = Import(records, bundle);
      synced.fresh += imported.fresh;
      synced.known += imported.known;
      // One that was cut short is recovered by its mark.
      if (is_spare && bundle.attempts[0].outcome == AttemptOutcome::kRunning)
        AttemptMark(records.folder(), bundle.attempts[0].id).Leave();
      fs::remove(file, fault);
    } catch (const Error& refused) {
      // Without a database that can be written none of them will go.
      if (refused.code() != Code::kBadData) throw;
      synced.refused.emplace_back(refused.what());
    }
}

}  // namespace

fs::path KeepInOutbox(const fs::path& folder, const RecordsBundle& bundle) {
  try {
    return WriteToOutbox(folder, bundle);
  } catch (const Error&) {
    const fs::path spare = SpareFolder(folder);
    if (spare.empty()) throw;
    return WriteToOutbox(spare, bundle);
  }
}

RecordsBundle StartInOutbox(Random& random, const std::string& trainee_code,
                            const SessionRow& session, const ExerciseRow& exercise,
                            const std::string& started, AttemptMode mode) {
  RecordsBundle bundle;
  TraineeRow trainee;
  trainee.id = UuidOf(random);
  trainee.code = trainee_code;
  trainee.created = started;
  SessionRow own = session;
  if (own.id.empty()) own.id = UuidOf(random);
  if (own.started.empty()) own.started = started;
  own.trainee = trainee.id;
  AttemptRecord attempt;
  attempt.id = UuidOf(random);
  attempt.session = own.id;
  attempt.trainee = trainee.id;
  attempt.exercise = exercise.hash;
  attempt.started = started;
  attempt.mode = mode;
  attempt.log = LogNameOf(attempt.id);
  bundle.trainees = {trainee};
  bundle.sessions = {own};
  bundle.exercises = {exercise};
  bundle.attempts = {attempt};
  return bundle;
}

std::string FinishOrKeep(Records* records, const fs::path& folder, const RecordsBundle& bundle) {
  std::string why = "there is no database";
  if (records != nullptr) try {
      PutAttempt(*records, bundle, bundle.attempts.at(0));
      return {};
    } catch (const Error& fault) {
      why = fault.what();
    }
  try {
    const fs::path file = KeepInOutbox(folder, bundle);
    return fmt::format(
        "the attempt is kept in {}, since {}; `arthroscene records sync` brings it "
        "into the records",
        file.string(), why);
  } catch (const Error& fault) {
    throw Error(Code::kFile, fmt::format("the attempt could be written neither to the records ({}) "
                                         "nor to the outbox ({}); make room, then try again",
                                         why, fault.what()));
  }
}

Synced SyncOutbox(Records& records, const fs::path& folder) {
  Synced synced;
  Sync(records, folder, false, synced);
  if (const fs::path spare = SpareFolder(folder); !spare.empty()) {
    Sync(records, spare, true, synced);
    BringLogs(spare, folder);
  }
  return synced;
}

}  // namespace arthro::app

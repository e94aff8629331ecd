#include "app/records/attempts/outbox.h"

#include <algorithm>
#include <system_error>

#include <fmt/format.h>

#include "app/records/attempts/attempts.h"
#include "app/records/attempts/records_file.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"

namespace arthro::app {

namespace fs = std::filesystem;

fs::path OutboxOf(const fs::path& folder) { return folder / "outbox"; }

fs::path KeepInOutbox(const fs::path& folder, const RecordsBundle& bundle) {
  std::error_code fault;
  fs::create_directories(OutboxOf(folder), fault);
  if (fault)
    throw Error(Code::kFile, "the outbox could not be made: " + WhyNotWritten(fault.value()),
                OutboxOf(folder));
  const fs::path file = OutboxOf(folder) / (bundle.attempts.at(0).id + ".json");
  WriteAtomically(file, RecordsText(bundle), Access::kPrivate);
  return file;
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
  std::vector<fs::path> files;
  std::error_code fault;
  for (const auto& entry : fs::directory_iterator(OutboxOf(folder), fault))
    if (entry.path().extension() == ".json" && entry.path().filename().string()[0] != '.')
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) {
    RecordsBundle bundle;
    try {
      bundle = RecordsFromText(ReadWholeFile(file), file);
    } catch (const Error& damaged) {
      synced.refused.push_back(damaged.what());
      continue;
    }
    const Imported imported = Import(records, bundle);
    synced.fresh += imported.fresh;
    synced.known += imported.known;
    fs::remove(file, fault);
  }
  return synced;
}

}  // namespace arthro::app

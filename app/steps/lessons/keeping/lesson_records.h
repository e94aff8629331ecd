// Records that the window keeps of attempts: their place, the trainee of this session, and the
// attempt under way. Every fault of the database is a sentence here; the attempt goes on.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/records/keeping/kept_attempt.h"
#include "simulation/scene/files/loaded_scene.h"

namespace arthro::app {

struct LessonRecords {
  std::string place;              // connection; empty: nothing is kept
  std::unique_ptr<Records> open;  // null: not opened yet, or `fault` says why it cannot be
  std::string fault;
  std::string trainee;  // code that attempts are kept under; empty: none is chosen
  std::optional<SessionRow> session;
  std::string session_rig;               // devices of that session
  std::unique_ptr<KeptAttempt> attempt;  // under way, or over and not written yet
  // An attempt that is over and that neither the records nor the outbox took.
  std::optional<simulation::AttemptResult> unwritten;
};

// Opens the records. Attempts of the outbox move into them, and those that were cut short are
// assessed from their logs. Returns a sentence for each. A database that is not reached leaves
// `fault`.
std::vector<std::string> OpenRecords(LessonRecords& records);
// The same, unless they are open. False, with `fault`, where they cannot be reached.
bool ReachRecords(LessonRecords& records);

// Attempts from now on are those of this trainee. Returns false where nobody has the code yet.
// Throws Error for a text that is no code.
bool ChooseTrainee(LessonRecords& records, const std::string& code);
// Adds a trainee with this code, and chooses it. Throws Error.
void AddAndChooseTrainee(LessonRecords& records, const std::string& code);
// Ends the session of the trainee that is chosen.
void LeaveTrainee(LessonRecords& records);

// Begins to keep an attempt; without a place or a trainee nothing is kept. Returns a sentence where
// it is not kept as it should; empty where all is well.
std::string BeginKeeping(LessonRecords& records, const Exercise& exercise,
                         const LoadedScene& loaded, AttemptMode mode, const std::string& rig);
// Writes the result. Returns a sentence that says where the attempt is.
std::string EndKeeping(LessonRecords& records, const simulation::AttemptResult& result);

// Folder of logs and outbox.
std::filesystem::path FolderOf(const LessonRecords& records);
// Groups with this rig for the criteria of an exercise; none where the records are not reached.
std::vector<simulation::GroupValues> GroupsFor(LessonRecords& records, const Exercise& exercise,
                                               const std::string& rig);

}  // namespace arthro::app

#include "app/steps/lessons/keeping/lesson_records.h"

#include <fmt/format.h>

#include "app/records/attempts/outbox.h"
#include "app/records/people/trainees.h"
#include "simulation/core/error.h"
#include "simulation/scene/json/exercise_json.h"
#include "simulation/training/observe/surface_names.h"
#include "simulation/training/scene_of_attempt.h"

namespace arthro::app {
namespace {

constexpr double kPatience = 2;  // s for a locked file or a silent server; the window waits

std::string Program() { return "arthroscene " ARTHRO_VERSION; }

// The session of the chosen trainee with these devices.
void ReachSession(LessonRecords& records, const std::string& rig) {
  if (records.session && records.session_rig == rig) return;
  records.session.reset();
  if (!ReachRecords(records)) return;
  records.session = StartSession(*records.open, records.trainee, Program(), rig);
  records.session_rig = rig;
}

}  // namespace

std::filesystem::path FolderOf(const LessonRecords& records) {
  return RecordsFolder(records.place);
}

std::vector<std::string> OpenRecords(LessonRecords& records) {
  records.open.reset();
  records.fault.clear();
  if (records.place.empty()) return {};
  std::vector<std::string> sentences;
  try {
    RecordsOptions options;
    options.timeout = kPatience;
    records.open = std::make_unique<Records>(records.place, options);
    const Synced synced = SyncOutbox(*records.open, FolderOf(records));
    if (synced.fresh > 0)
      sentences.push_back(
          fmt::format("{} attempts of the outbox are in the records now.", synced.fresh));
    for (const std::string& refused : synced.refused) sentences.push_back(refused);
    for (const std::string& sentence : RecoverAttempts(
             *records.open,
             [&](const AttemptRecord& record) { return ResultFromLog(*records.open, record); }))
      sentences.push_back(sentence);
  } catch (const Error& fault) {
    records.fault = fault.what();
    sentences.push_back(records.fault);
  }
  return sentences;
}

bool ReachRecords(LessonRecords& records) {
  if (!records.open && !records.place.empty()) OpenRecords(records);
  return records.open != nullptr;
}

bool ChooseTrainee(LessonRecords& records, const std::string& code) {
  CheckTraineeCode(code);
  if (ReachRecords(records)) try {
      if (!KnowsTrainee(*records.open, code)) return false;
    } catch (const Error& fault) {  // the attempts go to the outbox
      records.fault = fault.what();
      records.open.reset();
    }
  LeaveTrainee(records);
  records.trainee = code;
  return true;
}

void AddAndChooseTrainee(LessonRecords& records, const std::string& code) {
  CheckTraineeCode(code);
  if (ReachRecords(records)) {
    TraineeRow trainee;
    trainee.code = code;
    AddTrainee(*records.open, trainee);
  }
  LeaveTrainee(records);
  records.trainee = code;
}

void LeaveTrainee(LessonRecords& records) {
  if (records.session && records.open) try {
      EndSession(*records.open, records.session->id);
    } catch (const Error& fault) {
      records.fault = fault.what();
    }
  records.session.reset();
  records.trainee.clear();
}

std::string BeginKeeping(LessonRecords& records, const Exercise& exercise,
                         const LoadedScene& loaded, AttemptMode mode, const std::string& rig) {
  records.attempt.reset();
  records.unwritten.reset();
  if (records.place.empty()) return "This attempt is not kept: this window has no records.";
  if (records.trainee.empty()) return "This attempt is not kept: no trainee is chosen.";
  std::string fault;
  try {
    ReachSession(records, rig);
    fault = records.fault;
  } catch (const Error& refused) {
    fault = refused.what();
  }
  AttemptPlan plan;
  plan.trainee = records.trainee;
  plan.exercise = ExerciseRowOf(exercise);
  plan.scene = loaded.scene.title;
  plan.scene_fingerprint = simulation::FingerprintOfScene(loaded);
  plan.surfaces = simulation::SurfaceNames(loaded.scene);
  plan.mode = mode;
  plan.program = Program();
  plan.rig = rig;
  records.attempt =
      std::make_unique<KeptAttempt>(records.open.get(), FolderOf(records), records.session, plan);
  for (const std::string& notice : records.attempt->notices()) fault = notice;
  return fault;
}

std::string EndKeeping(LessonRecords& records, const simulation::AttemptResult& result) {
  if (!records.attempt) return {};
  records.unwritten.reset();
  try {
    const std::string where =
        records.attempt->Finish(ReachRecords(records) ? records.open.get() : nullptr, result);
    std::string kept =
        where.empty() ? fmt::format("Kept for {} in the records.", records.trainee) : where;
    records.attempt.reset();
    // A connection that is lost is made anew for the next attempt.
    if (!where.empty()) records.open.reset(), records.session.reset();
    return kept;
  } catch (const Error& fault) {
    records.unwritten = result;
    return fault.what();
  }
}

std::vector<simulation::GroupValues> GroupsFor(LessonRecords& records, const Exercise& exercise,
                                               const std::string& rig) {
  if (!records.open) return {};
  try {
    return GroupValuesOf(*records.open, HashOf(exercise), rig);
  } catch (const Error& fault) {
    records.fault = fault.what();
    return {};
  }
}

}  // namespace arthro::app

#include "app/records/keeping/kept_attempt.h"

#include <utility>

#include "app/records/attempts/outbox.h"
#include "app/records/people/reference_groups.h"
#include "app/records/people/trainees.h"
#include "app/records/store/table.h"
#include "simulation/core/error.h"
#include "simulation/scene/json/exercise_json.h"
#include "simulation/training/attempt_head.h"
#include "simulation/training/score/recorded_result.h"

namespace arthro::app {

namespace fs = std::filesystem;

ExerciseRow ExerciseRowOf(const Exercise& exercise) {
  return {HashOf(exercise), exercise.id, exercise.title, CanonicalJson(exercise), exercise.version};
}

KeptAttempt::KeptAttempt(Records* records, const fs::path& folder,
                         const std::optional<SessionRow>& session, const AttemptPlan& plan)
    : folder_(FolderToWrite(folder)) {
  try {
    if (records != nullptr && session) StartInRecords(*records, *session, plan);
  } catch (const Error& fault) {
    bundle_ = {};
    mark_ = {};
    notices_.push_back(fault.what());
  }
  if (bundle_.attempts.empty()) StartApart(session, plan);
  StartLog(plan);
}

KeptAttempt::~KeptAttempt() {
  if (!is_finished_) mark_.Leave();
}

void KeptAttempt::StartInRecords(Records& records, const SessionRow& session,
                                 const AttemptPlan& plan) {
  bundle_.trainees = {FindTrainee(records, plan.trainee)};
  bundle_.sessions = {session};
  bundle_.exercises = {plan.exercise};
  StartedAttempt started = StartAttempt(records, session, plan.exercise, plan.scene, plan.mode,
                                        simulation::kMetricsVersion);
  bundle_.attempts = {started.record};
  mark_ = std::move(started.mark);
}

// The row `running` waits in the outbox, so that an attempt that is cut short comes into the
// records like any other.
void KeptAttempt::StartApart(const std::optional<SessionRow>& session, const AttemptPlan& plan) {
  Random random = RandomFromSystem();
  SessionRow own = session.value_or(SessionRow{});
  if (!session) {
    own.program = plan.program;
    own.rig = plan.rig;
    own.station = StationName();
  }
  bundle_ = StartInOutbox(random, plan.trainee, own, plan.exercise, UtcNow(), plan.mode);
  bundle_.attempts[0].scene = plan.scene;
  bundle_.attempts[0].metrics_version = simulation::kMetricsVersion;
  mark_ = AttemptMark(folder_, record().id);
  try {
    KeepInOutbox(folder_, bundle_);
  } catch (const Error& fault) {
    notices_.push_back(fault.what());
  }
}

void KeptAttempt::StartLog(const AttemptPlan& plan) {
  simulation::AttemptHead head{.attempt = record().id,
                               .exercise = plan.exercise.id,
                               .exercise_hash = plan.exercise.hash,
                               .scene = plan.scene,
                               .scene_fingerprint = plan.scene_fingerprint,
                               .mode = ToString(plan.mode),
                               .rig = plan.rig,
                               .started = record().started,
                               .program = plan.program,
                               .surfaces = plan.surfaces};
  // Twice as often as a program that is killed may lose.
  constexpr double kWriteEvery = 0.1;  // s
  const auto begin = [&](const fs::path& folder) {
    log_ = std::make_unique<simulation::AttemptLog>(
        folder / record().log, std::span<const simulation::LogSource>(),
        simulation::AttemptHeadText(head), simulation::AttemptLogOptions{kWriteEvery});
    log_folder_ = folder;
  };
  try {
    begin(folder_);
  } catch (const Error& fault) {
    try {
      const fs::path spare = SpareFolder(folder_);
      if (spare.empty()) throw;
      std::error_code ignored;
      fs::create_directories((spare / record().log).parent_path(), ignored);
      begin(spare);
    } catch (const Error&) {
      notices_.emplace_back(fault.what());
    }
  }
}

void KeptAttempt::Add(std::span<const simulation::AttemptFrame> frames,
                      std::span<const simulation::AttemptEvent> events,
                      std::span<const simulation::TrackPiece> track) {
  if (log_ == nullptr) return;
  for (const simulation::AttemptFrame& frame : frames) log_->Add(frame);
  for (const simulation::AttemptEvent& event : events) log_->Add(event);
  for (const simulation::TrackPiece& piece : track) log_->Add(piece);
}

void KeptAttempt::CloseLog() {
  if (log_ != nullptr) try {
      log_->Close();
    } catch (const Error& fault) {
      notices_.push_back(fault.what());
    }
  log_.reset();
  SetLogSum(log_folder_, bundle_.attempts[0]);
}

std::string KeptAttempt::Finish(Records* records, const simulation::AttemptResult& result) {
  if (is_finished_) return {};
  CloseLog();
  SetResult(bundle_.attempts[0], result);
  std::string where = FinishOrKeep(records, folder_, bundle_);
  // A row that waited in the outbox since the begin is in the records now.
  if (std::error_code ignored; where.empty())
    fs::remove(OutboxOf(folder_) / (record().id + ".json"), ignored);
  is_finished_ = true;
  mark_ = {};
  return where;
}

std::vector<simulation::GroupValues> GroupValuesOf(Records& records,
                                                   const std::string& exercise_hash,
                                                   const std::string& rig) {
  std::vector<simulation::GroupValues> values;
  for (const ReferenceGroup& group :
       ReferenceGroupsAt(records, exercise_hash, simulation::kMetricsVersion, rig))
    for (const ReferenceValueRow& row : group.values)
      if (row.mean)
        values.push_back({group.name, row.metric, row.part, row.n, *row.mean, row.sd.value_or(0)});
  return values;
}

std::optional<simulation::AttemptResult> ResultFromLog(Records& records,
                                                       const AttemptRecord& record) {
  try {
    const auto recording = simulation::ReadAttempt(records.folder() / record.log);
    const auto exercise = Select<ExerciseRow>(records.database(), "exercises", "WHERE hash = :hash",
                                              {record.exercise});
    if (exercise.empty()) return std::nullopt;
    const simulation::AttemptHead head = simulation::AttemptHeadOf(recording.head);
    return simulation::ResultOfRecording(recording, ExerciseFromJson(exercise[0].json),
                                         head.surfaces,
                                         GroupValuesOf(records, record.exercise, head.rig));
  } catch (const Error&) {
    return std::nullopt;
  }
}

}  // namespace arthro::app

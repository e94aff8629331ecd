// An attempt from its begin to its record. The row `running` and the log come first, the results in
// one transaction at the end, whatever the outcome. Where the database refuses, the attempt goes to
// the outbox; where its program is killed, the next start recovers it from its log.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/records/attempts/attempts.h"
#include "simulation/training/attempt_log.h"
#include "simulation/training/score/criteria.h"

namespace arthro::app {

// Exercise, trainee and scene of an attempt that begins.
struct AttemptPlan {
  std::string trainee;  // code
  ExerciseRow exercise;
  std::string scene;                  // title
  std::string scene_fingerprint;      // simulation/training/scene_of_attempt.h
  std::vector<std::string> surfaces;  // names of the backdrop and of each tissue
  AttemptMode mode = AttemptMode::kPractice;
  std::string program, rig;
};

ExerciseRow ExerciseRowOf(const Exercise& exercise);

class KeptAttempt {
 public:
  // `records` null: none are reached. `session`: of the trainee; none: it could not be begun.
  // Nothing is thrown: `notices` says what could not be kept as it should.
  KeptAttempt(Records* records, const std::filesystem::path& folder,
              const std::optional<SessionRow>& session, const AttemptPlan& plan);
  // An attempt that was not finished keeps its mark, by which it is recovered.
  ~KeptAttempt();
  KeptAttempt(const KeptAttempt&) = delete;
  KeptAttempt& operator=(const KeptAttempt&) = delete;

  // Frames, events and pieces of the tissue track since the last call; each in the order of its
  // times.
  void Add(std::span<const simulation::AttemptFrame> frames,
           std::span<const simulation::AttemptEvent> events,
           std::span<const simulation::TrackPiece> track = {});

  // Writes the results; null: no records are reached. Returns "" where the records have them, else
  // a sentence that says where they are. Throws Error where neither records nor outbox take them;
  // then it may be called again.
  std::string Finish(Records* records, const simulation::AttemptResult& result);

  const AttemptRecord& record() const { return bundle_.attempts.front(); }
  // Everything that is recorded of the attempt, with what it refers to.
  const RecordsBundle& bundle() const { return bundle_; }
  const std::vector<std::string>& notices() const { return notices_; }

 private:
  void StartInRecords(Records& records, const SessionRow& session, const AttemptPlan& plan);
  void StartApart(const std::optional<SessionRow>& session, const AttemptPlan& plan);
  void StartLog(const AttemptPlan& plan);
  void CloseLog();

  std::filesystem::path folder_, log_folder_;
  RecordsBundle bundle_;  // with one attempt
  AttemptMark mark_;
  std::unique_ptr<simulation::AttemptLog> log_;  // null: it could not be begun, or it is closed
  std::vector<std::string> notices_;
  bool is_finished_ = false;
};

// Values of the reference groups of an exercise with this rig, for its criteria.
std::vector<simulation::GroupValues> GroupValuesOf(Records& records,
                                                   const std::string& exercise_hash,
                                                   const std::string& rig);

// Assesses an attempt from its log; nothing where the log or the exercise cannot be read.
std::optional<simulation::AttemptResult> ResultFromLog(Records& records,
                                                       const AttemptRecord& record);

}  // namespace arthro::app

// Attempts, exercises and trainees with values that tests know, as an exercise would give them.
#pragma once

#include <string>
#include <vector>

#include <fmt/format.h>

#include "app/records/attempts/attempts.h"
#include "app/records/people/trainees.h"

namespace arthro::test {

inline app::ExerciseRow SampleExercise(int number = 0) {
  app::ExerciseRow exercise;
  exercise.id = fmt::format("probe-five-{}", number);
  exercise.hash = fmt::format("{:064x}", 0xabc0 + number);
  exercise.title = "Probe five places";
  exercise.json = R"({"id": "probe-five"})";
  return exercise;
}

// A result with one missing value, and with the numbers of an attempt of `seconds`.
inline simulation::AttemptResult SampleResult(double seconds = 74, bool passes = false) {
  using namespace simulation;
  static constexpr Metric kTime{"task_time", "Time", "s",
                                "Time of the attempt without its pauses."},
      kForce{"peak_force", "Peak force", "N", "Largest force on the tip."},
      kLoss{"tool_loss", "Share with the tip out of view", "",
            "Share of the time in which the tip was not seen."};
  AttemptResult result;
  result.outcome = passes ? AttemptOutcome::kPassed : AttemptOutcome::kFailed;
  result.reason = passes ? "" : "The force on the instrument was 9.1 N; 8.5 N are allowed.";
  result.duration = seconds;
  result.steps = {{"s1", StepOutcome::kDone, 0, 0.4 * seconds},
                  {"s2", StepOutcome::kDone, 0.4 * seconds, seconds}};
  result.metrics = {{&kTime, "both", seconds, ""},
                    {&kForce, "instrument", passes ? 3.25 : 9.1, ""},
                    {&kLoss, "instrument", std::nullopt, "The tip was never in the joint."}};
  result.criteria = {
      {"peak_force", "instrument", {}, 8.5, passes ? 3.25 : 9.1, passes, "PMC3023859", false},
      {"task_time", "both", {}, 120.0, seconds, seconds <= 120, "own start value", true}};
  result.events = {{0, EventKind::kAttemptStart, "", "", 0, ""},
                   {0.4 * seconds, EventKind::kStepDone, "s1", "spine", 0, ""},
                   {0.6 * seconds, EventKind::kForceOver, "s2", "", 9.1, ""},
                   {seconds, EventKind::kAttemptEnd, "", "", 0, ""}};
  return result;
}

// Records with ids, times and station that repeat; the clock goes on by a second per question.
inline app::RecordsOptions RepeatedOptions(std::uint64_t seed = 1) {
  app::RecordsOptions options;
  options.station = "station-1";
  options.seed = seed;
  options.now = [second = 0]() mutable {
    ++second;
    return fmt::format("2026-11-23T{:02}:{:02}:{:02}.000Z", 8 + second / 3600, second / 60 % 60,
                       second % 60);
  };
  return options;
}

inline app::TraineeRow NewTrainee(const std::string& code, const std::string& cohort = "") {
  app::TraineeRow trainee;
  trainee.code = code;
  trainee.cohort = cohort;
  trainee.hand = "right";
  trainee.experience = 3;
  return trainee;
}

// One attempt from begin to end; returns it as it was recorded.
inline app::AttemptRecord Attempt(app::Records& records, const app::SessionRow& session,
                                  const app::ExerciseRow& exercise, double seconds = 74,
                                  bool passes = false,
                                  app::AttemptMode mode = app::AttemptMode::kTest) {
  auto running = app::StartAttempt(records, session, exercise, "Demo", mode, 1);
  app::SetResult(running.record, SampleResult(seconds, passes));
  app::FinishAttempt(records, running.record);
  return running.record;
}

}  // namespace arthro::test

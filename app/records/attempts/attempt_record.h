// Rows of the records as plain values: exercises, trainees, sessions, attempts with their steps,
// criteria, metrics and events, and filled forms. One list of fields per struct serves the tables,
// the files and their schema. SI units; times in UTC, or in s after the begin of an attempt.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "simulation/core/options.h"
#include "simulation/training/attempt_words.h"

namespace arthro::app {

inline constexpr Range kAnyNumber{std::numeric_limits<double>::lowest(),
                                  std::numeric_limits<double>::max()};
inline constexpr Range kAnyCount{0, 1e9};
inline const std::string kNoText;

enum class AttemptMode { kPractice, kTest, kRobot };
using simulation::AttemptOutcome;

inline Choices<AttemptMode> AttemptModes() {
  return {{{AttemptMode::kPractice, "practice"},
           {AttemptMode::kTest, "test"},
           {AttemptMode::kRobot, "robot"}}};
}
inline std::string ToString(AttemptMode mode) {
  return AttemptModes().words[static_cast<std::size_t>(mode)].second;
}
inline Choices<AttemptOutcome> AttemptOutcomes() {
  Choices<AttemptOutcome> choices;
  for (const auto outcome :
       {AttemptOutcome::kRunning, AttemptOutcome::kPassed, AttemptOutcome::kFailed,
        AttemptOutcome::kStopped, AttemptOutcome::kVoid})
    choices.words.emplace_back(outcome, simulation::ToString(outcome));
  return choices;
}

struct CohortRow {
  std::string id, name;
  template <class V>
  void Visit(V&& v) {
    v("id", id, Required{Any{}}, "", "UUID.");
    v("name", name, Required{Any{}}, "", "Name of the group of trainees.");
  }
};

struct TraineeRow {
  std::string id, code, cohort, hand, created;
  int experience = -1;
  template <class V>
  void Visit(V&& v) {
    v("id", id, Required{Any{}}, "", "UUID.");
    v("code", code, Required{Any{}}, "", "Pseudonym. Names stay in a file of the instructor.");
    v("cohort", cohort, LeftOutAt{kNoText, Any{}}, "", "UUID of the cohort.");
    v("hand", hand, Any{}, "", "Dominant hand: left, right, or empty for not stated.");
    v("experience", experience, LeftOutAt{-1, Range{-1, 1e6}}, "",
      "Arthroscopies done before. It is left out while unknown.");
    v("created", created, Required{Any{}}, "", "Time in UTC.");
  }
};

struct SessionRow {
  std::string id, trainee, station, started, ended, program, rig;
  template <class V>
  void Visit(V&& v) {
    v("id", id, Required{Any{}}, "", "UUID.");
    v("trainee", trainee, Required{Any{}}, "", "UUID of the trainee.");
    v("station", station, Any{}, "", "Name of the machine.");
    v("started", started, Required{Any{}}, "", "Time in UTC.");
    v("ended", ended, LeftOutAt{kNoText, Any{}}, "", "Time in UTC.");
    v("program", program, Any{}, "", "Version of the program.");
    v("rig", rig, Any{}, "", "Devices. Mouse, zero-force and force rigs never share a group.");
  }
};

struct ExerciseRow {
  std::string hash, id, title, json;
  int version = 1;
  template <class V>
  void Visit(V&& v) {
    v("hash", hash, Required{Any{}}, "", "SHA-256 of the exercise in canonical JSON.");
    v("id", id, Required{Any{}}, "", "Name of the exercise in its scene.");
    v("version", version, kAnyCount, "", "Raised by each edit.");
    v("title", title, Any{}, "", "Title.");
    v("json", json, Any{}, "", "The exercise in JSON.");
  }
};

struct StepRow {
  std::string step, outcome;
  double began = 0;
  std::optional<double> ended;
  template <class V>
  void Visit(V&& v) {
    v("step", step, Any{}, "", "Id of the step in the exercise.");
    v("began", began, kAnyNumber, "s", "Begin.");
    v("ended", ended, kAnyNumber, "s", "End.");
    v("outcome", outcome, Any{}, "", "pending, running, done or failed.");
  }
};

struct MetricRow {
  std::string name, part, unit, why_none;
  std::optional<double> value;
  int n = 0;
  template <class V>
  void Visit(V&& v) {
    v("name", name, Required{Any{}}, "", "Metric, as method.md lists them.");
    v("part", part, Any{}, "", "scope, instrument or both; for contacts what was touched.");
    v("value", value, kAnyNumber, "", "Value; left out where it was not measured.");
    v("unit", unit, Any{}, "", "Unit of the value.");
    v("n", n, kAnyCount, "", "Number of values that it was made of; 0 where not stated.");
    v("why_none", why_none, Any{}, "", "Reason for a missing value.");
  }
};

struct CriterionRow {
  std::string metric, part, source;
  std::optional<double> low, high, value;
  bool passed = false;
  template <class V>
  void Visit(V&& v) {
    v("metric", metric, Any{}, "", "Metric.");
    v("part", part, Any{}, "", "Part of the metric.");
    v("low", low, kAnyNumber, "", "Least value that passes.");
    v("high", high, kAnyNumber, "", "Largest value that passes.");
    v("value", value, kAnyNumber, "", "Value; left out where it was not measured.");
    v("passed", passed, Any{}, "", "An unmeasured criterion is not met.");
    v("source", source, Any{}, "", "Source of the limit.");
  }
};

struct EventRow {
  double t = 0;
  std::string kind, step, target, note;
  std::optional<double> value;
  template <class V>
  void Visit(V&& v) {
    v("t", t, kAnyNumber, "s", "Time after the begin.");
    v("kind", kind, Required{Any{}}, "", "Kind, such as step_done.");
    v("step", step, Any{}, "", "Id of the step.");
    v("target", target, Any{}, "", "Id of the target.");
    v("value", value, kAnyNumber, "", "N for forces, m³ for volumes, index of an answer.");
    v("note", note, Any{}, "", "Words of the trainee or the instructor.");
  }
};

struct AttemptRecord {
  std::string id, session, trainee, exercise, scene, started, reason, log, log_sha256;
  AttemptMode mode = AttemptMode::kPractice;
  AttemptOutcome outcome = AttemptOutcome::kRunning;
  std::optional<double> duration;
  int metrics_version = 0, log_bytes = -1;
  std::vector<StepRow> steps;
  std::vector<MetricRow> metrics;
  std::vector<CriterionRow> criteria;
  std::vector<EventRow> events;
  template <class V>
  void Visit(V&& v) {
    v("id", id, Required{Any{}}, "", "UUID.");
    v("session", session, Required{Any{}}, "", "UUID of the session.");
    v("trainee", trainee, Required{Any{}}, "", "UUID of the trainee.");
    v("exercise", exercise, Required{Any{}}, "", "Hash of the exercise.");
    v("scene", scene, Any{}, "", "Title of the scene.");
    v("mode", mode, AttemptModes(), "", "Attempts in mode test open gates.");
    v("started", started, Required{Any{}}, "", "Time in UTC.");
    v("duration", duration, Range{0, 1e9}, "s", "Duration without pauses.");
    v("outcome", outcome, AttemptOutcomes(), "", "Outcome. An attempt has no total.");
    v("reason", reason, Any{}, "", "One sentence; empty for a pass.");
    v("metrics_version", metrics_version, kAnyCount, "", "Version of the metrics.");
    v("log", log, Any{}, "", "File of the attempt in the folder of its station.");
    v("log_sha256", log_sha256, LeftOutAt{kNoText, Any{}}, "", "Checksum of that file.");
    v("log_bytes", log_bytes, LeftOutAt{-1, Range{-1, 2e9}}, "", "Size of that file.");
    v("steps", steps, Any{}, "", "Steps in the order of their begin.");
    v("metrics", metrics, Any{}, "", "Metrics.");
    v("criteria", criteria, Any{}, "", "Criteria in the order of the exercise.");
    v("events", events, Any{}, "", "Events in the order of their times.");
  }
};

struct FormItemRow {
  std::string item;
  int score = -1;
  template <class V>
  void Visit(V&& v) {
    v("item", item, Required{Any{}}, "", "Id of the item in the form.");
    v("score", score, LeftOutAt{-1, Range{-1, 1e6}}, "", "Left out where it was not rated.");
  }
};

struct FormRow {
  std::string id, attempt, form, rater, made, comment;
  int form_version = 1;
  bool blinded = false;
  std::vector<FormItemRow> items;
  template <class V>
  void Visit(V&& v) {
    v("id", id, Required{Any{}}, "", "UUID.");
    v("attempt", attempt, Required{Any{}}, "", "UUID of the attempt.");
    v("form", form, Required{Any{}}, "", "Id of the form.");
    v("form_version", form_version, kAnyCount, "", "Version of the form.");
    v("rater", rater, Any{}, "", "Code of the rater.");
    v("blinded", blinded, Any{}, "", "The rater did not know whose attempt it was.");
    v("made", made, Required{Any{}}, "", "Time in UTC.");
    v("comment", comment, Any{}, "", "Words of the rater.");
    v("items", items, Any{}, "", "Ratings.");
  }
};

// Whole attempts with all that they refer to: an export, an import, or a file of the outbox.
struct RecordsBundle {
  std::vector<CohortRow> cohorts;
  std::vector<TraineeRow> trainees;
  std::vector<ExerciseRow> exercises;
  std::vector<SessionRow> sessions;
  std::vector<AttemptRecord> attempts;
  std::vector<FormRow> forms;
  template <class V>
  void Visit(V&& v) {
    v("cohorts", cohorts, Any{}, "", "Cohorts.");
    v("trainees", trainees, Any{}, "", "Trainees by their codes.");
    v("exercises", exercises, Any{}, "", "Exercises that were done.");
    v("sessions", sessions, Any{}, "", "Sessions.");
    v("attempts", attempts, Any{}, "", "Attempts.");
    v("forms", forms, Any{}, "", "Filled forms.");
  }
};

}  // namespace arthro::app

// Report of an attempt as JSON, arthroscene.assessment/1: the only writer of that schema. The
// schema is resources/schemas/assessment-1.schema.json. SI units; a missing value is left out and
// says why.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/report/attempt_report.h"

namespace arthro::app {

std::string AttemptJson(const AttemptReport& report);
std::string AssessmentSchema();

// Fields of the file, in their order.
struct AssessedExercise {
  std::string id, hash, title;
  int version = 1;
  template <class V>
  void Visit(V&& v) {
    v("id", id, Required{Any{}}, "", "Id of the exercise in its scene.");
    v("version", version, kAnyCount, "", "Raised by each edit.");
    v("hash", hash, Any{}, "", "SHA-256 of the exercise in canonical JSON.");
    v("title", title, Any{}, "", "Title.");
  }
};

struct AssessedGroup {
  std::optional<double> n, median, q1, q3, z;
  template <class V>
  void Visit(V&& v) {
    v("n", n, kAnyCount, "", "Members with a value.");
    v("median", median, kAnyNumber, "", "Median of the group.");
    v("q1", q1, kAnyNumber, "", "Lower quartile.");
    v("q3", q3, kAnyNumber, "", "Upper quartile.");
    v("z", z, kAnyNumber, "",
      "Standard deviations from the group's mean, positive where better; of logarithms for times, "
      "paths and areas. Left out for fewer than five members.");
  }
};

struct AssessedCriterion {
  std::string metric, part, unit, source;
  std::optional<double> low, high, value;
  bool is_met = false;
  template <class V>
  void Visit(V&& v) {
    v("metric", metric, Required{Any{}}, "", "Metric.");
    v("part", part, Any{}, "", "Part of the metric.");
    v("min", low, kAnyNumber, "", "Least value that meets it.");
    v("max", high, kAnyNumber, "", "Largest value that meets it.");
    v("value", value, kAnyNumber, "", "Value; left out where it was not measured.");
    v("unit", unit, Any{}, "", "Unit of value and limits.");
    v("met", is_met, Any{}, "", "A criterion that was not measured is not met.");
    v("source", source, Any{}, "", "Source of the limit.");
  }
};

struct AssessedMetric {
  std::string metric, part, unit, better, why_none;
  std::optional<double> value;
  AssessedGroup group;
  template <class V>
  void Visit(V&& v) {
    v("metric", metric, Required{Any{}}, "", "Metric, as method.md lists them.");
    v("part", part, Any{}, "", "scope, instrument or both; for contacts what was touched.");
    v("value", value, kAnyNumber, "", "Value; left out where it was not measured.");
    v("unit", unit, Any{}, "", "Unit of the value.");
    v("better", better, Any{}, "", "more or less.");
    v("why_none", why_none, Any{}, "", "Reason for a missing value.");
    v("group", group, Any{}, "", "Values of the reference group.");
  }
};

struct AssessmentFile {
  std::string attempt, trainee, scene, mode, started, outcome, reason, group;
  std::optional<AssessedExercise> exercise;
  std::optional<double> duration;
  int frames = 0, unknown_frames = 0, metrics_version = 0;
  std::vector<AssessedCriterion> criteria;
  std::vector<StepRow> steps;
  std::vector<AssessedMetric> metrics;
  std::vector<EventRow> events;
  template <class V>
  void Visit(V&& v) {
    v("attempt", attempt, Any{}, "", "UUID of the attempt; left out for recorded hands.");
    v("trainee", trainee, Any{}, "", "Code of the trainee, where the records name one.");
    v("exercise", exercise, Any{}, "", "Exercise; left out where hands were measured without one.");
    v("scene", scene, Any{}, "", "Title of the scene.");
    v("mode", mode, Any{}, "", "practice, test or robot; left out where it is not known.");
    v("started", started, Any{}, "", "Time in UTC.");
    v("outcome", outcome, Any{}, "", "passed, failed, stopped or void. An attempt has no total.");
    v("reason", reason, Any{}, "", "One sentence; left out for a pass.");
    v("duration", duration, Range{0, 1e9}, "s", "Duration without pauses.");
    v("frames", frames, kAnyCount, "", "Frames of 10 ms.");
    v("unknown_frames", unknown_frames, kAnyCount, "", "Frames in which neither hand is known.");
    v("metrics_version", metrics_version, kAnyCount, "", "Version of the metrics.");
    v("group", group, Any{}, "", "Name of the reference group.");
    v("criteria", criteria, Any{}, "", "Criteria in the order of the exercise.");
    v("steps", steps, Any{}, "", "Steps in the order of the exercise.");
    v("metrics", metrics, Any{}, "", "Metrics.");
    v("events", events, Any{}, "", "Events in the order of their times.");
  }
};

}  // namespace arthro::app

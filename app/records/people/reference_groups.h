// Groups against which an attempt is read, such as experts: number, mean, standard deviation and
// quartiles of each metric over the attempts that a rule names. SI units.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/records/store/records.h"
#include "simulation/core/options.h"

namespace arthro::app {

struct ReferenceValueRow {
  std::string metric, part;
  int n = 0;
  std::optional<double> mean, sd, median, q1, q3;  // sd: none for n = 1
  template <class V>
  void Visit(V&& v) {
    const Range any{-1e300, 1e300};
    v("metric", metric, Required{Any{}}, "", "Metric.");
    v("part", part, Any{}, "", "Part of the metric.");
    v("n", n, Range{0, 1e9}, "", "Number of attempts with a value.");
    v("mean", mean, any, "", "Mean.");
    v("sd", sd, any, "", "Standard deviation of the sample.");
    v("median", median, any, "", "Median.");
    v("q1", q1, any, "", "Lower quartile.");
    v("q3", q3, any, "", "Upper quartile.");
  }
};

struct ReferenceGroup {
  std::string id, name, exercise, rule, made;  // exercise: its hash
  int metrics_version = 0;
  std::vector<ReferenceValueRow> values;
  template <class V>
  void Visit(V&& v) {
    v("id", id, Required{Any{}}, "", "UUID.");
    v("name", name, Required{Any{}}, "", "Name of the group.");
    v("exercise", exercise, Required{Any{}}, "", "Hash of the exercise.");
    v("metrics_version", metrics_version, Range{0, 1e9}, "", "Version of the metrics.");
    v("rule", rule, Any{}, "", "Attempts that count, in JSON.");
    v("made", made, Required{Any{}}, "", "Time in UTC.");
    v("values", values, Any{}, "", "Values of each metric.");
  }
};

// Attempts that count: those of the trainees at one exercise that were passed or failed, in mode
// test or practice; of each trainee the last one, or all.
struct ReferenceRule {
  std::vector<std::string> trainees;  // codes
  std::string mode = "test";
  std::string rig;  // words of its session; mouse, zero-force and force rigs never share a group
  bool is_last_only = true;
};

// Rig of the attempts that count for a group.
std::string RigOf(const ReferenceGroup& group);

// Computes a group anew; one of the same name, exercise and rig is replaced. Throws Error where no
// attempt counts, or where their metrics have several versions.
ReferenceGroup MakeReferenceGroup(Records& records, const std::string& name,
                                  const std::string& exercise_hash, const ReferenceRule& rule);
std::vector<ReferenceGroup> ReferenceGroupsOf(Records& records);
// Those of one exercise whose metrics are of this version, and whose attempts were made with the
// same rig: forces and paths of a mouse say nothing about those of a device.
std::vector<ReferenceGroup> ReferenceGroupsAt(Records& records, const std::string& exercise_hash,
                                              int metrics_version, const std::string& rig);
// Values of the attempts that count for the group now, by metric and part.
using MetricValues = std::map<std::pair<std::string, std::string>, std::vector<double>>;
MetricValues MemberValues(Records& records, const ReferenceGroup& group);

// Attempts that count for the group now and were passed, the newest first.
std::vector<std::string> PassedAttemptsOf(Records& records, const ReferenceGroup& group);

// Within a transaction: takes a trainee out of every group's rule and computes these again. A group
// that is empty then is removed. Returns their names.
std::vector<std::string> UpdateGroupsWithout(Records& records, const std::string& code);

}  // namespace arthro::app

// Report of one attempt: a page (HTML) that needs no other file and no script and prints on A4, and
// the same values as a table (CSV); as JSON in assessment_file.h. It states what was measured
// against which limit. It has no total, no stars and no percentage.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/records/attempts/attempt_record.h"
#include "app/report/report_picture.h"
#include "simulation/scene/exercise/exercise_target.h"
#include "simulation/training/observe/attempt_frame.h"
#include "simulation/training/track/track_piece.h"

namespace arthro::app {

// A metric of the attempt beside the values of a reference group, in SI units.
struct GroupStanding {
  std::string metric, part;
  int n = 0;
  std::optional<double> median, q1, q3;
  std::optional<double> z;  // positive is better; none for fewer than five members
};

struct AttemptReport {
  AttemptRecord attempt;
  ExerciseRow exercise;  // id empty: hands were measured without an exercise
  bool is_mode_known = true;
  std::string goal;          // brief of the exercise; may be empty
  std::string trainee;       // code
  std::string station, rig;  // from the session
  std::string program;       // version
  // Frames of the attempt, 10 ms apart; empty where its file is not at hand.
  std::vector<simulation::AttemptFrame> frames;
  std::vector<ExerciseTarget> targets;
  StepNames steps;
  std::string group;  // name of the reference group; empty: none
  std::vector<GroupStanding> standings;
  // Tissue of the frames, for pictures of a scene; drawn pictures.
  std::vector<simulation::TrackPiece> track;
  std::vector<ReportPicture> pictures;
  // Metrics of an expert's attempt; empty: there is none.
  std::vector<MetricRow> expert;
};

inline bool HasExercise(const AttemptReport& report) { return !report.exercise.id.empty(); }
// Null where the group has no such value.
const GroupStanding* StandingIn(const AttemptReport& report, const std::string& metric,
                                const std::string& part);

// First characters of the page: a job replaces no other page.
inline constexpr const char* kAttemptPageHead =
    "<!doctype html>\n<!-- arthroscene report of an attempt -->\n";
std::string AttemptPage(const AttemptReport& report);

inline constexpr const char* kMetricTableHead = "metric,part,value,";
std::string MetricTable(const AttemptReport& report);

}  // namespace arthro::app

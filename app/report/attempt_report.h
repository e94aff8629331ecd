// Report of one attempt: a page (HTML) that needs no other file and no script and prints on A4, the
// same values as JSON (arthroscene.assessment/1) and as a table (CSV). It states what was measured
// against which limit. It has no total, no stars and no percentage.
#pragma once

#include <string>
#include <vector>

#include "app/records/attempts/attempt_record.h"
#include "simulation/training/observe/attempt_frame.h"

namespace arthro::app {

struct AttemptReport {
  AttemptRecord attempt;
  ExerciseRow exercise;
  std::string goal;          // brief of the exercise; may be empty
  std::string trainee;       // code
  std::string station, rig;  // from the session
  std::string program;       // version
  // Frames of the attempt, 10 ms apart; empty where its file is not at hand.
  std::vector<simulation::AttemptFrame> frames;
  std::vector<std::string> targets;  // ids, in the order of the exercise
};

// First characters of the page: a job replaces no other page.
inline constexpr const char* kAttemptPageHead =
    "<!doctype html>\n<!-- arthroscene report of an attempt -->\n";
std::string AttemptPage(const AttemptReport& report);

std::string AttemptJson(const AttemptReport& report);
inline constexpr const char* kMetricTableHead = "metric,part,value,";
std::string MetricTable(const AttemptReport& report);

}  // namespace arthro::app

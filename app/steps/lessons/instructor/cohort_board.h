// Contents of the instructor's page: how each trainee stands at each exercise of the scene, and for
// a chosen one the learning curve, CUSUM as advice, and the gate. SI units.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/records/attempts/progress.h"
#include "app/records/attempts/standings.h"
#include "app/steps/lessons/lessons_step.h"

namespace arthro::app {

struct CohortCell {
  int tries = 0, passes = 0;
  std::string last;             // outcome of the last attempt; empty: none
  bool is_gate_passed = false;  // passed by tests
  bool is_gate_opened = false;  // opened by an instructor
};

struct CohortRowOfPage {
  std::string code;
  std::vector<CohortCell> cells;  // one per exercise of the scene
};

// A trainee's attempts at one exercise.
struct LearningCurve {
  std::vector<AttemptPoint> points;
  std::vector<std::optional<double>> median;      // median of the last three
  std::vector<double> cusum;                      // one per attempt that was passed or failed
  std::string advice;                             // one sentence; CUSUM decides nothing
  std::optional<std::pair<double, double>> band;  // quartiles of the reference group
  std::string band_words;                         // "experts, n = 6"; empty: no group
};

struct CohortBoard {
  std::vector<std::string> cohorts;  // names
  int cohort = -1;                   // −1: every one
  std::vector<CohortRowOfPage> rows;
  int row = -1, exercise = -1;  // chosen
  // Metrics of the chosen exercise that may be drawn, with their part: the time, then its criteria.
  std::vector<std::pair<std::string, std::string>> metrics;
  int metric = 0;
  LearningCurve curve;
  std::string who, reason;  // typed, for a gate that is opened
  std::string fault;
  int document = -1;  // number of the document with these exercises
  bool is_stale = true;
};

// `codes`: all trainees of the page, in their order.
std::vector<CohortRowOfPage> CohortRows(const std::vector<std::string>& codes,
                                        const std::vector<Exercise>& exercises,
                                        const std::vector<Standing>& standings);
// Returns what CUSUM says of finished attempts, oldest first.
std::string CusumAdvice(const std::vector<double>& cusum);
// Medians, sums and advice from the points.
LearningCurve CurveOf(std::vector<AttemptPoint> points);

// The page as the records have it now.
CohortBoard& FreshCohortBoard(EditorState& state);
void ChooseCohort(EditorState& state, int cohort);
void ChooseCell(EditorState& state, int row, int exercise);
void ChooseMetric(EditorState& state, int metric);

}  // namespace arthro::app

// Contents of the instructor's page: how each trainee stands at each exercise of the scene, and for
// a chosen one the learning curve, CUSUM as advice, and the gate. SI units.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/records/attempts/progress.h"
#include "app/records/attempts/standings.h"
#include "app/steps/lessons/instructor/instructor_choice.h"
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
  std::vector<CohortCell> cells;  // one per exercise of the scene; empty: not read yet
};

// A trainee's attempts at one exercise.
struct LearningCurve {
  std::vector<AttemptPoint> points;
  std::vector<std::optional<double>> median;      // median of the last three
  std::vector<double> cusum;                      // one per attempt that was passed or failed
  std::string advice;                             // one sentence; CUSUM decides nothing
  std::optional<std::pair<double, double>> band;  // quartiles of the reference group
  std::string band_words;                         // "experts, n = 6"; empty: no band
};

struct CohortBoard {
  std::vector<std::string> cohorts;             // names
  std::string search;                           // typed; part of the codes that are shown
  Performers performers = Performers::kPeople;  // whose attempts the page shows
  std::vector<CohortRowOfPage> rows;
  int row = -1, exercise = -1;  // chosen
  // Metrics of the chosen exercise that may be drawn, with their part: the time, then its criteria.
  std::vector<std::pair<std::string, std::string>> metrics;
  int metric = 0;
  std::vector<std::string> groups;  // names of the reference groups of the chosen exercise
  InstructorChoice choice;
  bool knows_choice = false;  // it was read
  LearningCurve curve;
  std::string who, reason;  // typed, for a gate that is opened
  std::string fault;
  std::vector<std::string> hashes;  // one per exercise
  int document = -1;                // number of the document with these exercises
  bool is_stale = true, is_curve_stale = true;
};

// Cells of one trainee. `hashes`: of the exercises; `standings`: of the trainee.
std::vector<CohortCell> CellsOf(const std::vector<Exercise>& exercises,
                                const std::vector<std::string>& hashes,
                                const std::vector<Standing>& standings);
// Returns what CUSUM says of finished attempts, oldest first.
std::string CusumAdvice(const std::vector<double>& cusum);
// Medians, sums and advice from the points.
LearningCurve CurveOf(std::vector<AttemptPoint> points);

// The page as the records have it now: codes, and the curve of the chosen cell.
CohortBoard& FreshCohortBoard(EditorState& state);
// Reads the cells of the rows from `first` to before `last`, which are shown; those that were read
// stay as they are.
void ReadShownRows(EditorState& state, int first, int last);
void ChooseCohort(EditorState& state, const std::string& cohort);  // empty: every one
void FindTrainees(EditorState& state, const std::string& part_of_code);
void ShowAttemptsOf(EditorState& state, Performers performers);
void ChooseCell(EditorState& state, int row, int exercise);
void ChooseMetric(EditorState& state, int metric);
// Draws the band of this group from now on; an empty name: of none.
void ChooseGroup(EditorState& state, const std::string& group);

}  // namespace arthro::app

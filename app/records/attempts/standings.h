// Standing of a trainee at each exercise: the rows of the start page and of the cohort's page.
// The database counts; no attempt is read whole.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/records/store/records.h"

namespace arthro::app {

struct Standing {
  std::string trainee, cohort;               // code, name
  std::string exercise, exercise_id, title;  // exercise: hash
  int version = 0, tries = 0, passes = 0;
  std::optional<double> best_time;  // s, of the attempts that passed
  std::string last_started, last_outcome;
  std::string test_outcomes;    // "PFP": finished attempts in mode test, oldest first
  bool is_gate_opened = false;  // an instructor did it
};

// Whose attempts count. Those of robots stand apart, and open no gate.
enum class Performers { kPeople, kRobots };

// One row per exercise that the trainee has tried.
std::vector<Standing> StandingsOf(Records& records, const std::string& trainee_code);
// The same for some trainees, in two statements; only their part of the index is read.
std::vector<Standing> StandingsOf(Records& records, std::span<const std::string> trainee_codes,
                                  Performers performers = Performers::kPeople);
// One row per trainee and exercise; an empty name means every cohort.
std::vector<Standing> CohortStandings(Records& records, const std::string& cohort_name = "");

}  // namespace arthro::app

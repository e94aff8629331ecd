// Contents of the trainee's page: how the trainee stands at each exercise of the scene, and whether
// it may be begun.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/records/attempts/attempt_record.h"
#include "app/records/attempts/standings.h"
#include "app/records/people/trainees.h"
#include "simulation/scene/exercise/exercise.h"
#include "simulation/training/score/learning.h"

namespace arthro::app {

struct ExerciseStanding {
  int tries = 0, passes = 0;
  std::optional<double> best_time;  // s
  std::string last_outcome;         // empty: never tried
  bool is_open = true;
  std::string needed;          // exercise that must be passed first; empty: it is open
  simulation::GateState gate;  // for the exercises that need this one
};

struct StartBoard {
  std::string code;                     // typed
  std::string unknown;                  // a code that nobody has yet, to be added
  std::string fault;                    // why a code was refused, or why nothing is known
  std::vector<ExerciseStanding> rows;   // one per exercise of the scene
  std::vector<AttemptRecord> attempts;  // those at the chosen exercise, newest first
  int attempts_of = -1;                 // exercise that they are of
  int document = -1;                    // number of the document with these exercises
  bool is_stale = true;
};

std::vector<std::string> HashesOf(const std::vector<Exercise>& exercises);
// `standings` and `opened` are those of one trainee; `hashes` those of the exercises.
std::vector<ExerciseStanding> StandingsFor(const std::vector<Exercise>& exercises,
                                           const std::vector<std::string>& hashes,
                                           const std::vector<Standing>& standings,
                                           const std::vector<GateRow>& opened);

}  // namespace arthro::app

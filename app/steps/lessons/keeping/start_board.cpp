#include "app/steps/lessons/keeping/start_board.h"

#include <algorithm>
#include <set>

#include "simulation/scene/json/exercise_json.h"

namespace arthro::app {
namespace {

// Tests at one exercise: those at earlier versions first.
std::vector<simulation::GateAttempt> TestsAt(const std::string& id, const std::string& hash,
                                             const std::vector<Standing>& standings) {
  std::vector<simulation::GateAttempt> tests;
  for (const bool is_own : {false, true})
    for (const Standing& standing : standings) {
      if (standing.exercise_id != id || (standing.exercise == hash) != is_own) continue;
      for (const char outcome : standing.test_outcomes)
        tests.push_back({standing.exercise, true, outcome == 'P'});
    }
  return tests;
}

}  // namespace

std::vector<std::string> HashesOf(const std::vector<Exercise>& exercises) {
  std::vector<std::string> hashes;
  hashes.reserve(exercises.size());
  for (const Exercise& exercise : exercises) hashes.push_back(HashOf(exercise));
  return hashes;
}

std::vector<ExerciseStanding> StandingsFor(const std::vector<Exercise>& exercises,
                                           const std::vector<std::string>& hashes,
                                           const std::vector<Standing>& standings,
                                           const std::vector<GateRow>& opened) {
  std::vector<ExerciseStanding> rows;
  std::set<std::string> passed;  // ids whose gates are open
  std::vector<bool> is_opened;   // opened by an instructor
  for (std::size_t i = 0; i < exercises.size(); ++i) {
    const Exercise& exercise = exercises[i];
    const std::string& hash = hashes.at(i);
    ExerciseStanding& row = rows.emplace_back();
    for (const Standing& standing : standings) {
      if (standing.exercise != hash) continue;
      row.tries = standing.tries;
      row.passes = standing.passes;
      row.best_time = standing.best_time;
      row.last_outcome = standing.last_outcome;
    }
    row.gate = simulation::GateOf(exercise.gate, hash, TestsAt(exercise.id, hash, standings));
    if (row.gate.is_open) passed.insert(exercise.id);
    is_opened.push_back(std::any_of(opened.begin(), opened.end(),
                                    [&](const GateRow& gate) { return gate.exercise == hash; }));
  }
  for (std::size_t i = 0; i < exercises.size(); ++i) {
    if (is_opened[i]) continue;
    const std::string needed = simulation::FirstShut(
        exercises[i], [&](const std::string& id) { return passed.contains(id); });
    if (needed.empty()) continue;
    const auto titled = std::find_if(exercises.begin(), exercises.end(),
                                     [&](const Exercise& other) { return other.id == needed; });
    const bool has_title = titled != exercises.end() && !titled->title.empty();
    rows[i].is_open = false;
    rows[i].needed = has_title ? titled->title : needed;
  }
  return rows;
}

}  // namespace arthro::app

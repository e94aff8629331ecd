// Faults in the exercises of a scene that its list of fields cannot express: names that lead
// nowhere, steps that never end, values that contradict each other.
#pragma once

#include <string>
#include <vector>

#include "simulation/scene/scene.h"

namespace arthro {

// One sentence per fault, with the key in scene.json; empty: none. Metrics are checked elsewhere
// (simulation/training/score/criteria_check.h).
std::vector<std::string> ExerciseFaults(const Scene& scene);

}  // namespace arthro

// The exercise with an id among those of a scene.
#pragma once

#include <string>
#include <vector>

#include "simulation/scene/exercise/exercise.h"

namespace arthro {

// Throws Error(kBadArgument) with the ids that there are.
const Exercise& ExerciseWithId(const std::vector<Exercise>& exercises, const std::string& id);

}  // namespace arthro

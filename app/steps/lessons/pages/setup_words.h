// Lens and instrument of an exercise in words.
#pragma once

#include <string>

#include "simulation/scene/exercise/exercise.h"

namespace arthro::app {

// "With the 30° scope, a punch or a shaver; the instrument enters on the left."; empty: the
// exercise asks for nothing.
std::string SetupWords(const ExerciseSetup& setup);

}  // namespace arthro::app

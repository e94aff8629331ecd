// Steps of an exercise in the words of a reader.
#pragma once

#include <string>

#include "simulation/scene/exercise/exercise.h"

namespace arthro::simulation {

// Text of the step, or its kind where it has no text; without the period of a sentence.
std::string StepTitle(const ExerciseStep& step);

// Step by its number and title, to begin a sentence: Step 2 "Touch the spine".
std::string StepWords(const Exercise& exercise, std::size_t step);

}  // namespace arthro::simulation

#include "simulation/training/steps/step_words.h"

#include <fmt/format.h>

namespace arthro::simulation {

std::string StepTitle(const ExerciseStep& step) {
  std::string title = BaseOf(step).text.empty() ? KindOf(step) : BaseOf(step).text;
  if (title.ends_with('.')) title.pop_back();
  return title;
}

std::string StepWords(const Exercise& exercise, std::size_t step) {
  return fmt::format("Step {} \"{}\"", step + 1, StepTitle(exercise.steps.at(step)));
}

}  // namespace arthro::simulation

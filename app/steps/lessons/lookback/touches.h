// Places that the tools touched in an attempt, for the look back. Portal frame, m, N, s.
#pragma once

#include <span>
#include <vector>

#include "app/steps/lessons/lessons_step.h"

namespace arthro::app {

// Places in the order of their times; one for each 0.5 mm, and another one there when the force
// grows beyond care or harm.
std::vector<TouchMark> TouchesOf(std::span<const simulation::AttemptFrame> frames);

}  // namespace arthro::app

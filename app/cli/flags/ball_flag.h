// A ball on the command line: X,Y,Z,R in mm, in the own frame of a surface.
#pragma once

#include <string>

#include "simulation/scene/tissue_parts.h"

namespace arthro::app {

// Throws CLI::ValidationError with the name of the flag.
Ball BallFromWords(const std::string& flag, const std::string& words);

}  // namespace arthro::app

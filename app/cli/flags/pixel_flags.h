// Pixels on the command line: a rectangle X,Y,W,H, or two pixels X,Y:X,Y.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include <glm/vec2.hpp>

#include "authoring/footage/pixel_box.h"

namespace arthro::app {

// Throws CLI::ValidationError with the name of the flag.
authoring::PixelBox BoxFromWords(const std::string& flag, const std::string& words);

// "x,y:x,y". `sentence` says what the flag takes.
std::pair<glm::dvec2, glm::dvec2> PixelsFromWord(const char* flag, std::string_view word,
                                                 const char* sentence);

}  // namespace arthro::app

// What lengths and places scene.json may hold.
#pragma once

#include "simulation/scene/json_object_reader.h"

namespace arthro {

// A joint is centimetres wide, so a length of metres means that millimetres were written.
inline constexpr JsonLimits kLength{0, 2, "metres", true};
inline constexpr JsonLimits kCoordinate{-2, 2, "metres"};

}  // namespace arthro

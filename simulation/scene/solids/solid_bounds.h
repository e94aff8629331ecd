// Axis-aligned box around a solid (simulation/scene/solids/solid.h), not always the smallest. A
// solid without end has infinite sides; one whose parts cannot meet has an empty box. m.
#pragma once

#include "simulation/core/geometry/box3.h"
#include "simulation/scene/solids/solid.h"

namespace arthro {

Box3 BoundsOfSolid(const Solid& solid);

}  // namespace arthro

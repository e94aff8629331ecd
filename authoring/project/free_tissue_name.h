// Name of a tissue that no other tissue of its scene has: reports and commands tell tissues apart
// by it.
#pragma once

#include <string>

#include "simulation/scene/scene.h"

namespace arthro::authoring {

// Returns `wanted`, or "wanted 2", "wanted 3" and on where that name is taken.
std::string FreeTissueName(const Scene& scene, const std::string& wanted);

}  // namespace arthro::authoring

// One sentence for a trainee whose instrument meets bone with its shaft. Pure. m.
#pragma once

#include "simulation/practice/snapshot.h"

namespace arthro::simulation {

// Empty where the shaft is free.
const char* ShaftNotice(const ToolState& instrument) noexcept;

}  // namespace arthro::simulation

// Solves a case (case_io.h): its equilibrium, or a number of implicit Euler steps from rest. Loads
// and displacements act from the first step on.
#pragma once

#include "simulation/core/progress.h"
#include "simulation/tissue/cases/case_io.h"

namespace arthro::simulation {

// Throws Error for a material, mesh or set that cannot be solved; the result tells whether it
// converged.
CaseResult RunCase(const TissueCase& tissue_case, const Progress& progress = {});

}  // namespace arthro::simulation

// Solves a case (case_io.h): its equilibrium, or so many steps of implicit Euler from rest under
// loads and displacements that are there from the first step on.
#pragma once

#include "simulation/core/progress.h"
#include "simulation/tissue/cases/case_io.h"

namespace arthro::simulation {

// Throws Error for a material, mesh or set that cannot be solved with; what did not converge is in
// the result.
CaseResult RunCase(const TissueCase& tissue_case, const Progress& progress = {});

}  // namespace arthro::simulation

// What the author's cuts and regions of a scene come to, beside what CheckScene finds: what each
// cut takes, one that misses its tissue, a piece that nothing holds any more. Costs nothing for
// tissues that have neither.
#pragma once

#include "simulation/scene/scene_check.h"
#include "simulation/scene/scene_io.h"

namespace arthro::simulation {

void CheckCuts(const LoadedScene& loaded, SceneFindings& findings);

}  // namespace arthro::simulation

// Findings about the author's cuts and regions, in addition to those of CheckScene: the volume that
// the cuts remove, a cut that misses its tissue, a piece that is no longer held. Tissues without
// cuts and regions cost nothing.
#pragma once

#include "simulation/scene/files/scene_check.h"
#include "simulation/scene/files/scene_io.h"

namespace arthro::simulation {

void CheckCuts(const LoadedScene& loaded, SceneFindings& findings);

}  // namespace arthro::simulation

// Places of the targets of an exercise in a scene.
#pragma once

#include <vector>

#include "simulation/scene/exercise/exercise.h"
#include "simulation/training/observe/target_place.h"

namespace arthro::simulation {

// One place per target, in the order of the exercise; that of regions is the middle of the first.
// Throws Error(kBadScene) for a target that lies on nothing.
std::vector<TargetPlace> PlacesOfTargets(const LoadedScene& loaded, const Exercise& exercise);
// The same with the relief of the scene (ReliefOf), for several exercises.
std::vector<TargetPlace> PlacesOfTargets(const LoadedScene& loaded, const Exercise& exercise,
                                         const DepthField& relief);

}  // namespace arthro::simulation

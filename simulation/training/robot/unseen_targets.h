// Check of the exercises of a scene: targets of steps that no pose of the scope sees, so that the
// exercise cannot be passed. Poses are those of PoseSearch, tissues are at rest.
#pragma once

#include <string>
#include <vector>

#include "simulation/core/progress.h"
#include "simulation/scene/exercise/exercise.h"
#include "simulation/scene/files/loaded_scene.h"

namespace arthro::simulation {

// A target that is seen with none of these view angles, within the limits of a step.
struct UnseenTarget {
  std::string exercise, target;
  std::vector<double> view_angles;  // rad
  friend bool operator==(const UnseenTarget&, const UnseenTarget&) = default;
};

// Targets of all exercises, each named once per exercise. Throws Error for a target that lies on
// nothing and for cuts that cannot be made.
std::vector<UnseenTarget> UnseenTargets(const LoadedScene& loaded);
// Those of one exercise, whether or not the scene has it. Throws Error(kCancelled) when stopped.
std::vector<UnseenTarget> UnseenTargets(const LoadedScene& loaded, const Exercise& exercise,
                                        const Progress& progress);
std::string AnglesOf(const UnseenTarget& unseen);  // "30° or 70°"
std::string ToString(const UnseenTarget& unseen);  // one sentence for the author

}  // namespace arthro::simulation

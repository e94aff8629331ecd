// Mirror image of an exercise in the plane x = 0 of the portal frame, for the other knee.
#pragma once

#include "simulation/scene/exercise/exercise.h"

namespace arthro {

// The version stays. A recorded expert has no mirror image, so `ghost` is cleared.
Exercise Mirrored(Exercise exercise);

}  // namespace arthro

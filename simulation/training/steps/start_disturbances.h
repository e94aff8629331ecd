// Disturbances of a session in the state that an exercise asks for: shares, 0 to 1.
#pragma once

#include <algorithm>

#include "simulation/scene/exercise/exercise.h"
#include "simulation/scope/disturbances.h"

namespace arthro::simulation {

// `haze`: of a bleeding that a step has begun (Strip); the stronger one counts.
inline Disturbances DisturbancesOf(const StartDisturbances& start, double haze = 0) {
  Disturbances now;
  now.haze = std::max(start.haze, haze);
  now.bubbles = start.bubbles;
  now.debris = start.debris;
  now.fog = start.fog;
  now.near_blur = start.near_blur;
  now.far_blur = start.far_blur;
  now.overexposure = start.overexposure;
  return now;
}

}  // namespace arthro::simulation

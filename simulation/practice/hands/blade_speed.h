// Speed at which the blade of a running shaver is drawn, slow enough for the eye to follow. A real
// blade turns 50 times per second, and a picture at 60 Hz would show it standing still.
#pragma once

namespace arthro::simulation {

inline constexpr double kBladeSpeed = 30.0;  // rad/s

}  // namespace arthro::simulation

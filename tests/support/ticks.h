// Time steps that most tests take.
#pragma once

namespace arthro::test {

inline constexpr double kTick = 1e-3;       // s, of the servo
inline constexpr double kFrame = 1.0 / 60;  // s, of the window and of tissue

}  // namespace arthro::test

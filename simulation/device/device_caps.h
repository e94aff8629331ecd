// Capabilities of a haptic device [method.md, Output chain]. Logic depends on these and never on
// the name of a device. SI units; device frame. A value that a device lacks is 0.
#pragma once

#include <glm/vec3.hpp>

namespace arthro::simulation {

// Method by which a device reports the hand.
enum class HandInput {
  kNone,      // buttons only
  kAbsolute,  // position, and orientation with six degrees of freedom
  kRate,      // push and turn of a knob, from which a hand is integrated
};

enum class Feedback { kNone, kForce, kRumble };

struct DeviceCaps {
  HandInput input = HandInput::kNone;
  Feedback feedback = Feedback::kNone;
  int sensed_dof = 0, actuated_dof = 0;
  double position_quantum = 0;  // m, smallest reported step
  double gimbal_sigma = 0;      // rad, standard deviation of the direction of the handle
  double peak_force = 0;        // N; for a rumbling device, the force shown at full amplitude
  double continuous_force = 0;  // N, that it can give permanently
  double max_stiffness = 0;     // N/m at the hand, largest that it renders without vibration
  double damping = 0;           // N s/m, own damping of the device
  double rate = 0;              // Hz, report rate
  int delay_ticks = 0;          // periods of `rate` from command to force
  glm::dvec3 min_hip{0.0}, max_hip{0.0};  // m, box that the hand can reach
  int buttons = 0;
  double watchdog = 0;  // s, for which its firmware holds a force without reports; 0: permanently
};

constexpr bool HasHand(const DeviceCaps& caps) noexcept { return caps.input != HandInput::kNone; }
constexpr bool HasForce(const DeviceCaps& caps) noexcept {
  return caps.feedback == Feedback::kForce && caps.actuated_dof > 0 && caps.peak_force > 0;
}
// True for a device that reports all the time; only such a device is lost when it is silent.
constexpr bool IsSteady(const DeviceCaps& caps) noexcept {
  return caps.input == HandInput::kAbsolute;
}

}  // namespace arthro::simulation

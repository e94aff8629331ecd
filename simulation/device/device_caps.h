// Capabilities of a haptic device [method.md, Output chain]. Logic asks this and never for a
// device's name. SI; device frame. A value that a device lacks is 0.
#pragma once

#include <glm/vec3.hpp>

namespace arthro::simulation {

// How a device says where the hand is.
enum class HandInput {
  kNone,      // it does not: buttons only
  kAbsolute,  // position, and orientation with six degrees of freedom
  kRate,      // how hard it is pushed and turned; a hand is integrated from that
};

enum class Feedback { kNone, kForce, kRumble };

struct DeviceCaps {
  HandInput input = HandInput::kNone;
  Feedback feedback = Feedback::kNone;
  int sensed_dof = 0, actuated_dof = 0;
  double position_quantum = 0;            // m, smallest step that it reports
  double gimbal_sigma = 0;                // rad, standard deviation of the handle's direction
  double peak_force = 0;                  // N; of a rumbling one, what is its full amplitude
  double continuous_force = 0;            // N, that it bears for ever
  double max_stiffness = 0;               // N/m at the hand, that it renders without trembling
  double damping = 0;                     // N s/m of its own
  double rate = 0;                        // Hz, of its reports
  int delay_ticks = 0;                    // of `rate`, from command to force
  glm::dvec3 min_hip{0.0}, max_hip{0.0};  // m, box that the hand reaches
  int buttons = 0;
  double watchdog = 0;  // s, that its firmware holds a force when nobody speaks; 0: for ever
};

constexpr bool HasHand(const DeviceCaps& caps) noexcept { return caps.input != HandInput::kNone; }
constexpr bool HasForce(const DeviceCaps& caps) noexcept {
  return caps.feedback == Feedback::kForce && caps.actuated_dof > 0 && caps.peak_force > 0;
}
// One that only speaks when something changes is not lost because it is silent.
constexpr bool IsSteady(const DeviceCaps& caps) noexcept {
  return caps.input == HandInput::kAbsolute;
}

}  // namespace arthro::simulation

// Explains in one sentence why a hand feels no force; the first obstacle to remove comes first.
// Pure. s.
#pragma once

#include "simulation/device/device_caps.h"
#include "simulation/device/device_state.h"
#include "simulation/haptics/output/fault.h"

namespace arthro::simulation {

// Kind of input that holds a hand.
enum class HandKind { kMouse, kRecorded, kSimulated, kPluggedIn };

struct ForceSituation {
  HandKind kind = HandKind::kMouse;
  DeviceCaps caps;
  DeviceStatus status;
  double sample_age = 0;
  bool is_dead_man_held = false;
  bool is_zero_force = false;   // forces are shown and not commanded
  bool is_calibrating = false;  // an incision is calibrated, and no device pushes
  bool is_practising = false;   // devices push only in a practice
  Fault fault = Fault::kNone;   // fault of the session
  bool has_force = false;       // the session computes a force
};

// Empty where there is force.
const char* WhyNoForce(const ForceSituation& situation) noexcept;

}  // namespace arthro::simulation

// Why a hand feels no force, in one sentence for the person who asks, the first thing to be mended
// first. Pure. s.
#pragma once

#include "simulation/device/device_caps.h"
#include "simulation/device/device_state.h"
#include "simulation/haptics/fault.h"

namespace arthro::simulation {

// What holds a hand.
enum class HandKind { kMouse, kRecorded, kSimulated, kPluggedIn };

struct ForceSituation {
  HandKind kind = HandKind::kMouse;
  DeviceCaps caps;
  DeviceStatus status;
  double sample_age = 0;
  bool is_dead_man_held = false;
  bool is_zero_force = false;   // the mode: shown, not commanded
  bool is_calibrating = false;  // an incision: no device pushes meanwhile
  bool is_practising = false;   // devices push only then
  Fault fault = Fault::kNone;   // of the session
  bool has_force = false;       // the session has one to give
};

// Empty: there is force.
const char* WhyNoForce(const ForceSituation& situation) noexcept;

}  // namespace arthro::simulation

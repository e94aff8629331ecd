// From the force on a tip to what a hand is given, the one way that every force takes, with or
// without hardware [method.md, Output chain]. In this order: not a number → zero and a fault ·
// lever · passivity guard · clamp, lower while the motors are warm · rise · speed guard · ramp.
// Before it stands the virtual coupling (contact.h), behind it the conversion to a device's own
// numbers, that saturates. Any one frame; m, N, s; noexcept, allocates nothing.
#pragma once

#include "simulation/haptics/force_limiter.h"
#include "simulation/haptics/lever.h"
#include "simulation/haptics/passivity.h"
#include "simulation/haptics/thermal.h"

namespace arthro::simulation {

enum class HandPush {
  kYes,
  kPause,  // not in this tick; from zero again, at the rise
  kNo,     // the device is not armed; ramps when it is
};

struct OutputOptions {
  const PassivityOptions& passivity;
  const ThermalOptions& thermal;
  const LimiterOptions& limiter;
};

struct TipForce {
  glm::dvec3 force{0.0};       // on the tip
  double stiffness = 0;        // N/m, at the tip, of all that gave way for it
  Lever lever;                 // of the rod
  glm::dvec3 hand{0.0};        // where it is
  double hand_speed = 0;       // m/s
  Fault fault = Fault::kNone;  // what went wrong before
  HandPush push = HandPush::kYes;
  bool is_elastic = false;  // of springs alone: what they give back is bounded by what was paid
};

struct OutputState {
  PassivityState guard;
  ThermalState thermal;
  LimiterState limiter;
};

LimitedForce ForceToHand(const OutputOptions& options, const TipForce& tip, double dt,
                         OutputState& state) noexcept;

}  // namespace arthro::simulation

// Output chain: converts the force on a tip to the force for a hand; every force passes it
// [method.md, Output chain]. In this order: not a number → zero and a fault · lever · passivity
// guard · clamp, lower while the motors are warm · rise · speed guard · ramp. The virtual coupling
// (contact.h) comes before it; the saturating conversion to the numbers of a device comes after it.
// All vectors are in the same frame; m, N, s; noexcept, allocates nothing.
#pragma once

#include "simulation/haptics/output/force_limiter.h"
#include "simulation/haptics/output/lever.h"
#include "simulation/haptics/output/passivity.h"
#include "simulation/haptics/output/thermal.h"

namespace arthro::simulation {

enum class HandPush {
  kYes,
  kPause,  // no force in this tick; then rises from zero
  kNo,     // the device is not armed; ramps up when it is
};

struct OutputOptions {
  const PassivityOptions& passivity;
  const ThermalOptions& thermal;
  const LimiterOptions& limiter;
};

struct TipForce {
  glm::dvec3 force{0.0};       // on the tip
  double stiffness = 0;        // N/m at the tip, of all compliances in series
  Lever lever;                 // lever of the rod
  glm::dvec3 hand{0.0};        // position of the hand
  double hand_speed = 0;       // m/s
  Fault fault = Fault::kNone;  // fault of an earlier stage
  HandPush push = HandPush::kYes;
  bool is_elastic = false;  // springs alone: returned energy is bounded by the energy paid
};

struct OutputState {
  PassivityState guard;
  ThermalState thermal;
  LimiterState limiter;
};

LimitedForce ForceToHand(const OutputOptions& options, const TipForce& tip, double dt,
                         OutputState& state) noexcept;

}  // namespace arthro::simulation

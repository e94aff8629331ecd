// Thermal limit of a motor [method.md, Output chain]. The mean of the sent force over about 10 s
// lowers the largest force that may be sent next, so that the mean stays below the continuous
// force. N, s; noexcept, allocates nothing.
#pragma once

#include "simulation/core/options.h"

namespace arthro::simulation {

struct ThermalOptions {
  double continuous_force = 0;  // N; 0: there is no motor, or it bears its peak force permanently
  double memory = 10.0;         // s; thermal time constant of the windings of a small motor
  template <class V>
  void Visit(V&& v) {
    v("continuous_force", continuous_force, Range{0, 20}, "N",
      "Force that a device can give permanently; the mean force stays below it. 0: no limit.");
    v("thermal_memory", memory, Range{0.1, 600}, "s", "Time over which the mean force is taken.");
  }
};

struct ThermalState {
  double mean = 0;  // N
};

// Returns the largest force that may be sent: `max_force` while the mean is below three quarters of
// the continuous force, then falling to slightly less than the continuous force.
double ThermalClamp(const ThermalOptions& options, double max_force,
                    const ThermalState& state) noexcept;
// Adds a force that was sent for `dt`.
void NoteHeat(const ThermalOptions& options, double force, double dt, ThermalState& state) noexcept;

}  // namespace arthro::simulation

// Force that a motor bears for ever and force that it bears for a while [method.md, Output chain]:
// the mean of the force that was sent, over some ten seconds, lowers the largest force that may be
// sent next, so that the mean stays below the continuous force whatever is asked for. N, s;
// noexcept, allocates nothing.
#pragma once

#include "simulation/core/options.h"

namespace arthro::simulation {

struct ThermalOptions {
  double continuous_force = 0;  // N; 0: there is no motor, or it bears its peak for ever
  double memory = 10.0;         // s; a small motor's windings
  template <class V>
  void Visit(V&& v) {
    v("continuous_force", continuous_force, Range{0, 20}, "N",
      "What a device bears for ever; a longer mean above it is not asked of it. 0: no limit.");
    v("thermal_memory", memory, Range{0.1, 600}, "s", "Time over which that mean is taken.");
  }
};

struct ThermalState {
  double mean = 0;  // N
};

// At most `max_force`. Full while the mean is below three quarters of the continuous force; from
// there it goes down, to a little less than the continuous force.
double ThermalClamp(const ThermalOptions& options, double max_force,
                    const ThermalState& state) noexcept;
// What was sent for `dt`.
void NoteHeat(const ThermalOptions& options, double force, double dt, ThermalState& state) noexcept;

}  // namespace arthro::simulation

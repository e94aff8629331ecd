#include "simulation/haptics/output/thermal.h"

#include <algorithm>
#include <cmath>

namespace arthro::simulation {
namespace {

// Shares of the continuous force. A twentieth compensates for the warm-up: ∫F dt is at most
// kUpper·(t + memory), which is below t from 190 s on.
constexpr double kLower = 0.75, kUpper = 0.95;

}  // namespace

double ThermalClamp(const ThermalOptions& options, double max_force,
                    const ThermalState& state) noexcept {
  const double bears = kUpper * options.continuous_force;
  if (!(options.continuous_force > 0) || !(max_force > bears)) return max_force;
  const double cool =
      std::clamp((kUpper - state.mean / options.continuous_force) / (kUpper - kLower), 0.0, 1.0);
  return bears + (max_force - bears) * cool;
}

void NoteHeat(const ThermalOptions& options, double force, double dt,
              ThermalState& state) noexcept {
  if (!std::isfinite(force) || !(dt > 0) || !std::isfinite(dt)) return;
  // Exact for a force that is constant over the step.
  state.mean = force + (state.mean - force) * std::exp(-dt / options.memory);
}

}  // namespace arthro::simulation

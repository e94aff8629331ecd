#include "simulation/practice/device_options.h"

#include <algorithm>
#include <cmath>

namespace arthro::simulation {

double StableStiffness(double device_damping, const ContactOptions& contact, double period,
                       double delay) noexcept {
  const double late = 0.5 * period + delay;
  const double whole = (device_damping + contact.damping) / late;
  if (contact.stiffness <= whole) return whole;
  return device_damping / (late - contact.damping / contact.stiffness);
}

double FreshFor(const DeviceCaps& caps, double period) noexcept {
  constexpr double kReports = 2.0;  // report intervals between two samples, the second late by one
  return HasForce(caps) || !IsSteady(caps) || caps.rate <= 0 ? 0.0 : kReports / caps.rate + period;
}

SessionOptions OptionsFor(const DeviceCaps& caps, double period, SessionOptions options) noexcept {
  if (!HasForce(caps)) return options;
  const double delay = caps.rate > 0 ? caps.delay_ticks / caps.rate : 0.0;
  double& stiffness = options.lever.max_stiffness;
  stiffness = std::min(stiffness, StableStiffness(caps.damping, options.contact, period, delay));
  if (caps.max_stiffness > 0) stiffness = std::min(stiffness, caps.max_stiffness);
  options.limiter.max_force = std::min(options.limiter.max_force, caps.peak_force);
  const int late = static_cast<int>(std::lround(delay / period));
  options.passivity.delay = std::clamp(late, options.passivity.delay, 7);
  options.passivity.quantum = std::max(options.passivity.quantum, caps.position_quantum);
  double& bears = options.thermal.continuous_force;
  if (caps.continuous_force > 0)
    bears = bears > 0 ? std::min(bears, caps.continuous_force) : caps.continuous_force;
  return options;
}

}  // namespace arthro::simulation

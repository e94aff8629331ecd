// Session options limited by the capabilities of a device [method.md, Output chain; method.md,
// Stability]. Limits are only lowered and the delay of the guard only grows, so several devices can
// be applied one after the other. N, N/m, s.
#pragma once

#include "simulation/device/device_caps.h"
#include "simulation/practice/session_options.h"

namespace arthro::simulation {

// Largest stiffness at the hand with which a sampled viscous spring does not oscillate when nobody
// holds the device: K (T/2 + t_d) < b + B [Gil et al. 2004; Hulin et al. 2006]. b is the damping of
// the device. The viscosity B of the coupling falls with its stiffness (contact.h), so a spring
// lowered to s K must satisfy s K (T/2 + t_d) < b + s B.
double StableStiffness(double device_damping, const ContactOptions& contact, double period,
                       double delay) noexcept;

// Time in s for which a sample of the device counts as fresh, where the session options say less. A
// report that comes late by one interval is then not stale: the Hydra reports every 4 ms, and the
// limit for a hand with force is 5 ms. 0 for a device with force, for which the options hold.
double FreshFor(const DeviceCaps& caps, double period) noexcept;

// `period` is that of the servo, s. A device without force changes nothing.
SessionOptions OptionsFor(const DeviceCaps& caps, double period, SessionOptions options) noexcept;

}  // namespace arthro::simulation

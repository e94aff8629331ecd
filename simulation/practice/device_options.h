// What a device can bear and show, as the options of a session that feels through it [method.md,
// Output chain; method.md, Stability]. It only ever lowers, and makes the guard look further back,
// so that several devices may be asked one after the other. N, N/m, s.
#pragma once

#include "simulation/device/device_caps.h"
#include "simulation/practice/session_options.h"

namespace arthro::simulation {

// Largest stiffness at the hand that a sampled spring with viscosity may have and not swing when
// nobody holds the device: K (T/2 + t_d) < b + B [Gil et al. 2004; Hulin et al. 2006]. b: of the
// device; the coupling's own viscosity B goes down with its stiffness (contact.h), so that one
// that is lowered to s K must keep s K (T/2 + t_d) < b + s B.
double StableStiffness(double device_damping, const ContactOptions& contact, double period,
                       double delay) noexcept;

// s, that a sample of it is fresh for though the session's options may say less, so that a report
// that comes late by a whole interval is not called stale: the Hydra's 4 ms alone are nearly the
// 5 ms that a hand with force is allowed. 0 where there is force: then the options hold.
double FreshFor(const DeviceCaps& caps, double period) noexcept;

// `period` of the servo. A device without force changes nothing.
SessionOptions OptionsFor(const DeviceCaps& caps, double period, SessionOptions options) noexcept;

}  // namespace arthro::simulation

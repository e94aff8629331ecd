// Lists the plugged-in devices once the kernel shows the expected number of them, or after 10 s of
// the guest's time.
#pragma once

#include <vector>

#include "simulation/device/hid/hid_link.h"
#include "simulation/device/live/live_link.h"

namespace arthro::test {

inline std::vector<simulation::KnownDevice> WhenListed(std::size_t count) {
  const auto bus = simulation::MachineHidBus();
  std::vector<simulation::KnownDevice> known;
  for (const double start = simulation::SteadySeconds();
       known.size() != count && simulation::SteadySeconds() - start < 10;)
    known = simulation::KnownAmong(bus->List());
  return known;
}

}  // namespace arthro::test

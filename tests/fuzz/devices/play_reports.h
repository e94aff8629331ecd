// Reports of a device from a fuzz input, through its driver as a live device uses it.
#pragma once

#include <string_view>

#include "simulation/device/driver/drivers.h"
#include "tests/fuzz/fuzz_input.h"

namespace arthro::test {

// Each report is a byte with its length, then its bytes. A length of 255 means that the device was
// opened again, 254 that it shall be homed. Whatever comes, places are finite, orientations are
// unit, and no report with a force is longer than its room.
void PlayReports(simulation::DeviceDriver& driver, std::string_view bytes);

}  // namespace arthro::test

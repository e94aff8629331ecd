// `arthroscene devices --first-hour`: the walk of first_hour.h with a device that is plugged in.
#pragma once

#include <string>
#include <vector>

#include "simulation/core/progress.h"
#include "simulation/device/hid/hid_link.h"

namespace arthro::app {

struct FirstHourArguments {
  std::string serial;  // empty: the only device with a force
  std::string record;  // file of the page to sign; empty: none
  std::string model;   // arm, for a WoodenHaptics
  std::vector<std::string> openhaptics;
};

// Throws Error(kDevice) where no step can be done, or not all passed; the record is written first.
void WalkFirstHour(simulation::HidBus& bus, const FirstHourArguments& arguments,
                   const Progress& progress);

}  // namespace arthro::app

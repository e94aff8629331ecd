// The drivers that there are, and which one a device gets.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "simulation/device/driver/device_driver.h"
#include "simulation/device/driver/wooden_model.h"
#include "simulation/device/hid/hid_node.h"

namespace arthro::simulation {

// `is_padded`: RawHID boards, whose reports are 64 bytes.
std::unique_ptr<DeviceDriver> MakeWoodenDriver(const WoodenModel& model, bool is_padded);
std::unique_ptr<DeviceDriver> MakeSpaceMouseDriver();
std::unique_ptr<DeviceDriver> MakeHydraDriver();
// `family`: kDualSense or kDualShock4.
std::unique_ptr<DeviceDriver> MakePadDriver(DeviceFamily family, bool is_bluetooth);

// `model` is needed where one family has several geometries (WoodenHaptics), since the numbers on
// the bus do not tell them apart. nullptr: `refusal` says in a sentence why it is not driven.
std::unique_ptr<DeviceDriver> MakeDriver(const KnownDevice& device, std::string_view model,
                                         std::string& refusal);

}  // namespace arthro::simulation

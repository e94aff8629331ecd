// Drivers of all families, and the choice for a device.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "simulation/device/driver/device_driver.h"
#include "simulation/device/driver/wooden_model.h"
#include "simulation/device/hid/hid_node.h"

namespace arthro::simulation {

// `is_padded`: for RawHID boards, whose reports have 64 bytes.
std::unique_ptr<DeviceDriver> MakeWoodenDriver(const WoodenModel& model, bool is_padded);
std::unique_ptr<DeviceDriver> MakeSpaceMouseDriver();
std::unique_ptr<DeviceDriver> MakeHydraDriver();
// `family`: kDualSense or kDualShock4.
std::unique_ptr<DeviceDriver> MakePadDriver(DeviceFamily family, bool is_bluetooth);

// Makes the driver of a device. `model` is needed where a family has several geometries
// (WoodenHaptics), which the numbers on the bus do not distinguish. nullptr: `refusal` is a
// sentence with the reason.
std::unique_ptr<DeviceDriver> MakeDriver(const KnownDevice& device, std::string_view model,
                                         std::string& refusal);

}  // namespace arthro::simulation

#include <fmt/format.h>

#include "simulation/device/driver/drivers.h"

namespace arthro::simulation {
namespace {

constexpr std::uint16_t kTeensy = 0x16c0;  // vendor; its RawHID reports have 64 bytes

}  // namespace

std::unique_ptr<DeviceDriver> MakeDriver(const KnownDevice& device, std::string_view model,
                                         std::string& refusal) {
  switch (device.family) {
    case DeviceFamily::kWoodenHaptics:
      if (const WoodenModel* known = FindWoodenModel(model))
        return MakeWoodenDriver(*known, device.node.vendor == kTeensy);
      if (model.empty())
        refusal = fmt::format(
            "which arm it is cannot be read from it, and a wrong one would push the wrong way; "
            "name its model ({}) in the rig file",
            WoodenModelWords());
      else if (IsSecretWoodenModel(model))
        refusal = fmt::format("the kinematics of {} are not published, so it is not driven; {} are",
                              model, WoodenModelWords());
      else
        refusal =
            fmt::format("there is no model {}; name {} in the rig file", model, WoodenModelWords());
      return nullptr;
    case DeviceFamily::kSpaceMouse:
      return MakeSpaceMouseDriver();
    case DeviceFamily::kHydra:
      return MakeHydraDriver();
    case DeviceFamily::kDualSense:
    case DeviceFamily::kDualShock4:
      return MakePadDriver(device.family, device.node.is_bluetooth);
  }
  return nullptr;
}

}  // namespace arthro::simulation

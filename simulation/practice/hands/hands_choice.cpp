#include "simulation/practice/hands/hands_choice.h"

#include <fmt/format.h>

#include "simulation/core/error.h"
#include "simulation/device/driver/drivers.h"
#include "simulation/device/log/log_replay.h"
#include "simulation/device/openhaptics/openhaptics_devices.h"
#include "simulation/scene/json/rig_io.h"

namespace arthro::simulation {
namespace {

// Refuses a device that this program cannot drive, before the practice begins.
void CheckDriven(const RigDevice& own, const char* where, const std::filesystem::path& rig) {
  if (IsOpenHaptics(own)) {
    if (!HasOpenHaptics())
      throw Error(Code::kDevice, fmt::format("{}: {}", where, kNoOpenHaptics), rig);
    return;
  }
  KnownDevice device;
  device.family = DeviceFamilyFromString(own.family).value_or(device.family);
  std::string refusal;
  if (!MakeDriver(device, own.model, refusal))
    throw Error(Code::kBadData, fmt::format("{}: {}", where, refusal), rig);
}

}  // namespace

bool IsOpenHaptics(const RigDevice& device) { return device.family == kOpenHapticsWord; }

HandsChoice ReadHands(const std::filesystem::path& rig, const std::string& hands) {
  HandsChoice choice;
  if (!rig.empty()) {
    choice.rig = ReadRig(rig);
    choice.rig_file = rig;
    if (choice.rig->scope) CheckDriven(choice.rig->scope->device, "scope", rig);
    if (choice.rig->instrument) CheckDriven(choice.rig->instrument->device, "instrument", rig);
    if (choice.rig->pedals) CheckDriven(choice.rig->pedals->device, "pedals", rig);
  }
  choice.is_simulated = hands == "plant";
  if (!hands.empty() && !choice.is_simulated) choice.trace = ReadTraceOrLog(hands, choice.notice);
  return choice;
}

}  // namespace arthro::simulation

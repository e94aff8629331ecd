#include "simulation/scene/json/rig_file.h"

#include <algorithm>

namespace arthro {
namespace {

constexpr const char* kFamilies[] = {"wooden_haptics", "space_mouse", "razer_hydra",
                                     "openhaptics",    "dual_sense",  "dual_shock_4"};
constexpr std::size_t kHandFamilies = 4;  // the first of them
constexpr const char* kModels[] = {"woodenhaptics_2015", "polhem_v1"};

}  // namespace

const char* Word(RigAction action) noexcept {
  switch (action) {
    case RigAction::kDeadMan:
      return "dead_man";
    case RigAction::kCloseJaws:
      return "close_jaws";
    case RigAction::kNextInstrument:
      return "next_instrument";
  }
  return "";
}

std::span<const char* const> RigFamilies() noexcept { return kFamilies; }

std::span<const char* const> RigModels() noexcept { return kModels; }

bool IsHandFamily(const std::string& family) noexcept {
  return std::find(kFamilies, kFamilies + kHandFamilies, family) != kFamilies + kHandFamilies;
}

glm::dvec3 RestingHip(const DeviceRig& mount, double depth) {
  const glm::dvec3 in_device =
      glm::conjugate(mount.portal_from_device) * glm::dvec3(0, 0, mount.rod_length - depth);
  return mount.pivot - in_device;
}

}  // namespace arthro

// What is plugged in, and which of it we know: by vendor, product and usage, since one vendor's
// numbers are on mice and keyboards too [devices.md, Families].
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace arthro::simulation {

struct HidNode {
  std::uint16_t vendor = 0, product = 0, usage_page = 0, usage = 0;
  int interface_number = -1;
  bool is_bluetooth = false;
  std::string serial, product_name, path;
};

enum class DeviceFamily { kWoodenHaptics, kSpaceMouse, kHydra, kDualSense, kDualShock4 };

// One word, as in rig files, and the name for a person.
const char* ToString(DeviceFamily family) noexcept;
const char* Name(DeviceFamily family) noexcept;
std::optional<DeviceFamily> DeviceFamilyFromString(std::string_view word) noexcept;
std::span<const DeviceFamily> AllFamilies() noexcept;

// The numbers that a family is known by.
struct HidNumber {
  std::uint16_t vendor, product;
  DeviceFamily family;
};
std::span<const HidNumber> KnownNumbers() noexcept;

// Nothing: a device that is not ours, or a part of one that does not speak of hands.
std::optional<DeviceFamily> FamilyOf(const HidNode& node) noexcept;

struct KnownDevice {
  HidNode node;
  DeviceFamily family;
};

// Those of `nodes` that we know, each once, in the order of family, serial and path.
std::vector<KnownDevice> KnownAmong(std::span<const HidNode> nodes);

}  // namespace arthro::simulation

// HID nodes that are plugged in, and the families that this program knows. Nodes are identified by
// vendor, product and usage, since mice and keyboards share the numbers of a vendor [devices.md,
// Families].
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

// Text in rig files, and the name for the user.
const char* ToString(DeviceFamily family) noexcept;
const char* Name(DeviceFamily family) noexcept;
std::optional<DeviceFamily> DeviceFamilyFromString(std::string_view word) noexcept;
std::span<const DeviceFamily> AllFamilies() noexcept;

// Vendor and product numbers of a family.
struct HidNumber {
  std::uint16_t vendor, product;
  DeviceFamily family;
};
std::span<const HidNumber> KnownNumbers() noexcept;

// Returns the family of a node; nullopt for an unknown device, or a part of one that does not
// report the hand.
std::optional<DeviceFamily> FamilyOf(const HidNode& node) noexcept;

struct KnownDevice {
  HidNode node;
  DeviceFamily family;
};

// Returns the known devices among `nodes`, each once, in order of family, serial number and path.
std::vector<KnownDevice> KnownAmong(std::span<const HidNode> nodes);

}  // namespace arthro::simulation

// Newest sample of one haptic device: position of the hand and orientation of the handle. Device
// frame, m, s.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace arthro::simulation {

struct DeviceSample {
  double t = 0;                   // s, clock of the device; a new sample has a new t
  glm::dvec3 hip_in_device{0.0};  // haptic interface point
  glm::dquat handle_in_device{1.0, 0.0, 0.0, 0.0};  // w, x, y, z; unit
  std::uint32_t buttons = 0;                        // bit field; bit 0 is the first button
  bool valid = false;                               // false: no device, or no sample from it
};

// The two hands of an arthroscopy.
enum class DeviceRole { kScope, kInstrument };
inline constexpr std::array kDeviceRoles{DeviceRole::kScope, DeviceRole::kInstrument};

// Index into arrays that hold one entry per role.
constexpr std::size_t Index(DeviceRole role) noexcept { return static_cast<std::size_t>(role); }

// Text in files: `scope` or `instrument`.
constexpr const char* ToString(DeviceRole role) noexcept {
  return role == DeviceRole::kScope ? "scope" : "instrument";
}
constexpr std::optional<DeviceRole> DeviceRoleFromString(std::string_view text) noexcept {
  for (const DeviceRole role : kDeviceRoles)
    if (text == ToString(role)) return role;
  return std::nullopt;
}

}  // namespace arthro::simulation

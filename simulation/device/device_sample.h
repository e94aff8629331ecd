// What one haptic device said last: where the hand is and how it holds the handle. Device frame, m,
// s.
#pragma once

#include <cstdint>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace arthro::simulation {

struct DeviceSample {
  double t = 0;                   // s, the device's clock; a new sample has a new t
  glm::dvec3 hip_in_device{0.0};  // haptic interface point
  glm::dquat handle_in_device{1.0, 0.0, 0.0, 0.0};  // w, x, y, z; unit
  std::uint32_t buttons = 0;                        // bit 0: the first button
  bool valid = false;                               // false: there is no device, or it said nothing
};

// The two hands of an arthroscopy.
enum class DeviceRole { kScope, kInstrument };

}  // namespace arthro::simulation

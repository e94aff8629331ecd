// A rig: which device holds the scope and which the instrument, and how each is mounted on its
// incision. It belongs to a place, not to a scene, so that one scene is practised on many rigs.
// Read from rig files, arthroscene.rig/1. A role follows a serial number and never a port. SI.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "simulation/scene/scene.h"

namespace arthro {

// What a button or a pedal does.
enum class RigAction { kDeadMan, kCloseJaws, kNextInstrument };
inline constexpr int kRigActions = 3;
const char* Word(RigAction action) noexcept;

// Bit of DeviceSample::buttons; −1: none.
using RigButtons = std::array<int, kRigActions>;
inline constexpr RigButtons kNoButtons{-1, -1, -1};

struct RigDevice {
  std::string family;  // a word of device families
  // Empty: the only one of its family. Of openhaptics the name that its maker's setup tool gave it,
  // and the tool's default where it is empty.
  std::string serial;
  std::string model;  // of a WoodenHaptics, whose numbers on the bus do not say it
  int hand = 0;       // of a device with two
};

struct RigRole {
  RigDevice device;
  DeviceRig mount;
  double max_force = 0;      // N; 0: what the device bears
  double max_stiffness = 0;  // N/m at the hand; 0: what it renders
  RigButtons buttons = kNoButtons;
};

struct RigPedals {
  RigDevice device;
  RigButtons buttons = kNoButtons;
};

struct RigFile {
  std::string title;
  std::optional<RigRole> scope, instrument;  // without one: by mouse and keys
  std::optional<RigPedals> pedals;
};

// The words that `family` may be, and those of them that know where a hand is.
std::span<const char* const> RigFamilies() noexcept;
bool IsHandFamily(const std::string& family) noexcept;

// Where the hand rests for the tip to be `depth` beyond the incision, straight in; device frame.
glm::dvec3 RestingHip(const DeviceRig& mount, double depth);

}  // namespace arthro

// Rig: the devices that hold scope and instrument, and their mounts on the incisions. It belongs to
// a place, not to a scene, so that one scene is practised on many rigs. Read from rig files,
// arthroscene.rig/1. A role follows a serial number and never a port. SI.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "simulation/scene/scene.h"

namespace arthro {

// Action of a button or a pedal.
enum class RigAction { kDeadMan, kCloseJaws, kNextInstrument };
inline constexpr int kRigActions = 3;
const char* Word(RigAction action) noexcept;

// Bit of DeviceSample::buttons; −1: none.
using RigButtons = std::array<int, kRigActions>;
inline constexpr RigButtons kNoButtons{-1, -1, -1};

struct RigDevice {
  std::string family;  // a word of device families
  // Empty: the only device of its family. For openhaptics: the name in its maker's setup tool;
  // empty: the tool's default device.
  std::string serial;
  std::string model;  // arm of a WoodenHaptics, which USB does not report
  int hand = 0;       // 0 or 1 of a device with two hands
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

// Words that `family` may be, and whether a family measures the position of a hand.
std::span<const char* const> RigFamilies() noexcept;
bool IsHandFamily(const std::string& family) noexcept;

// Position of the hand when the tip is `depth` beyond the incision, straight in; device frame.
glm::dvec3 RestingHip(const DeviceRig& mount, double depth);

}  // namespace arthro

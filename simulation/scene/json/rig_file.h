// Rig: the devices that hold scope and instrument, and their mounts on the incisions. It belongs to
// a place, not to a scene, so that one scene is practised on many rigs. Read from rig files,
// arthroscene.rig/1. A role follows a serial number and never a port. SI. Each Visit lists the
// fields of the file once: name, rule, unit, help (core/options.h).
#pragma once

#include <array>
#include <filesystem>
#include <iterator>
#include <optional>
#include <span>
#include <string>

#include "simulation/core/options.h"
#include "simulation/scene/limits/scene_limits.h"
#include "simulation/scene/scene.h"

namespace arthro {

// Action of a button or a pedal.
enum class RigAction { kDeadMan, kCloseJaws, kNextInstrument };
inline constexpr int kRigActions = 3;
const char* Word(RigAction action) noexcept;

// Bit of DeviceSample::buttons; −1: none.
using RigButtons = std::array<int, kRigActions>;
inline constexpr RigButtons kNoButtons{-1, -1, -1};

// The buttons as fields of a file.
struct ButtonsInFile {
  RigButtons& buttons;
  template <class V>
  void Visit(V&& v) {
    constexpr Range kBits{0, 31};
    constexpr const char* kHelp[] = {"Button that is held for force.",
                                     "Button that closes the jaws.",
                                     "Button that takes the next instrument."};
    for (std::size_t i = 0; i < kRigActions; ++i)
      v(Word(static_cast<RigAction>(i)), buttons[i], LeftOutAt{-1, kBits}, "", kHelp[i]);
  }
};

// Words that `family` may be, and whether a family measures the position of a hand.
std::span<const char* const> RigFamilies() noexcept;
bool IsHandFamily(const std::string& family) noexcept;
// Arms of a WoodenHaptics whose kinematics are published.
std::span<const char* const> RigModels() noexcept;

struct RigDevice {
  std::string family;  // a word of device families
  // Empty: the only device of its family. For openhaptics: the name in its maker's setup tool;
  // empty: the tool's default device.
  std::string serial;
  std::string model;  // arm of a WoodenHaptics, which USB does not report
  int hand = 0;       // 0 or 1 of a device with two hands
  template <class V>
  void Visit(V&& v) {
    v("family", family, Required{Words{RigFamilies()}}, "", "Family of the device.");
    v("serial", serial, Any{}, "",
      "Serial number, as `arthroscene devices` lists it. For openhaptics: the name in its maker's "
      "setup tool, and the tool's default device if not given.");
    v("model", model, Words{RigModels()}, "",
      "Arm of a wooden_haptics, which must have one: a wrong arm pushes the wrong way.");
    v("hand", hand, LeftOutAt{0, Range{0, 1}}, "", "Hand of a razer_hydra.");
  }
};

// Instruments of different lengths on one rod: how far the tip of each lies beyond the end of the
// rod, m, along it; negative for a shorter one. In the order of kInstrumentKinds.
struct TipOffsets {
  std::array<double, std::size(kInstrumentKinds)> beyond_rod{};
  friend bool operator==(const TipOffsets&, const TipOffsets&) = default;
  template <class V>
  void Visit(V&& v) {
    constexpr Range kBeyond{-0.1, 0.1};  // m; a longer one is another rod
    constexpr const char* kHelp[] = {
        "Tip of the probe beyond the end of the rod; negative: before it.",
        "Tip of the punch beyond the end of the rod; negative: before it.",
        "Tip of the shaver beyond the end of the rod; negative: before it.",
        "Tip of the grasper beyond the end of the rod; negative: before it."};
    for (std::size_t i = 0; i < beyond_rod.size(); ++i)
      v(kInstrumentKinds[i], beyond_rod[i], LeftOutAt{0.0, kBeyond}, "m", kHelp[i]);
  }
};

// A shorter rod does not reach a joint through its incision, a longer one is no instrument. m
inline constexpr Range kRodRange{0.05, 0.6};

struct RigRole {
  RigDevice device;
  DeviceRig mount;
  TipOffsets tip_offsets;       // beyond the instrument's rod
  double hand_to_incision = 0;  // m, with the handle in its rest; 0: not given
  double max_force = 0;         // N; 0: what the device bears
  double max_stiffness = 0;     // N/m at the hand; 0: what it renders
  RigButtons buttons = kNoButtons;
  template <class V>
  void Visit(V&& v) {
    v("device", device, Required{Any{}}, "", "Device that is held.");
    v("rod_length", mount.rod_length, Required{kRodRange}, "m", "From the hand to the tip.");
    v("hand_to_incision", hand_to_incision, LeftOutAt{0.0, kLength}, "m",
      "From the hand to the incision, with the handle in its rest; checked against the rod.");
    v("tip_offsets", tip_offsets, Any{}, "",
      "Instruments that are longer or shorter than the rod; only the instrument's hand has them.");
    mount.Visit(v, false);
    v("max_force", max_force, LeftOutAt{0.0, Range{0, 20, true}}, "N",
      "Largest force; the device's own if not given.");
    v("max_stiffness", max_stiffness, LeftOutAt{0.0, Range{0, 10000, true}}, "N/m",
      "Largest stiffness at the hand; the device's own if not given.");
    ButtonsInFile own{buttons};
    v("buttons", own, Any{}, "", "Buttons of the device by action.");
  }
};

struct RigPedals {
  RigDevice device;
  RigButtons buttons = kNoButtons;
  template <class V>
  void Visit(V&& v) {
    v("device", device, Required{Any{}}, "", "Device with the pedals.");
    ButtonsInFile own{buttons};
    v("buttons", own, Any{}, "", "Pedals by action.");
  }
};

struct RigFile {
  std::string title;
  std::optional<RigRole> scope, instrument;  // without one: by mouse and keys
  std::optional<RigPedals> pedals;
  template <class V>
  void Visit(V&& v) {
    v("title", title, Required{Any{}}, "", "Name for people.");
    v("scope", scope, Any{}, "", "Device of the scope.");
    v("instrument", instrument, Any{}, "", "Device of the instrument.");
    v("pedals", pedals, Any{}, "", "Device with pedals.");
  }
};

// Position of the hand when the tip is `depth` beyond the incision, straight in; device frame.
glm::dvec3 RestingHip(const DeviceRig& mount, double depth);

}  // namespace arthro

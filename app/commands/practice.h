// A practice session and the servo that ticks it, reads its hands and commands them. With mouse and
// keys, recorded or simulated hands the window drives the servo in 1 ms steps as often as time has
// passed, so that the same input gives the same pictures; what is plugged in has a thread that
// ticks at its own time.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "app/commands/devices/hands.h"
#include "authoring/project/document.h"
#include "simulation/session/scripted_device.h"
#include "simulation/session/servo_loop.h"
#include "simulation/tissue/body/tissue_preset.h"

namespace arthro::app {

class Practice {
 public:
  // Throws Error where the scene cannot be practised: no panorama, a material that is not among
  // the presets. Builds the depth field, the tissues' trees and their elements, which takes a
  // moment: make it in a job. Tissues that deform step on a thread of their own, or, so that the
  // same input gives the same pictures, inline.
  Practice(const authoring::Document& document,
           const std::vector<simulation::TissuePreset>& presets, simulation::TissuePace pace,
           const simulation::SessionOptions& options = {});

  // Runs the session for `seconds` more, or takes over what its thread did meanwhile; the hands
  // move evenly to where they are now. A pause longer than kLongestPause is not made up for: the
  // session then stood still. `hands`: what holds them, from the first call on, and must outlive
  // this; without, mouse and keys do. Where a device does not say where its hand is, that goes on
  // from where it was.
  void Advance(double seconds, Hands* hands = nullptr);
  static constexpr double kLongestPause = 0.1;  // s

  // As of the last Advance.
  const simulation::Snapshot& snapshot() const { return snapshot_; }
  double incision_spacing() const { return wish_.incision_spacing; }
  double view_angle() const { return wish_.view_angle; }
  void SetViewAngle(double view_angle) { wish_.view_angle = view_angle; }

  // Living tissues as of the last Advance; nullptr: none lives.
  const simulation::WorldPicture* tissues() const { return tissues_; }
  void ResetTissues();
  simulation::ToolKind instrument_kind() const { return wish_.instrument; }
  void SetInstrument(simulation::ToolKind kind) { wish_.instrument = kind; }
  // How a hand's device is mounted, from now on: its incision was calibrated.
  void SetMount(simulation::DeviceRole role, const DeviceRig& mount);
  // The button under the finger: jaws close, a shaver runs.
  void Press(bool is_pressed) { buttons_ = is_pressed ? 1u : 0u; }
  double blade_turn() const;  // of the shaver, rad

  double peak_force() const { return peak_force_; }  // N, largest on the instrument's tip so far
  // What about its thread went less than well; empty: nothing.
  const std::string& servo_sentence() const { return servo_sentence_; }

  // Where mouse and keys have the hands.
  simulation::ScriptedDevice& scope() { return by_mouse_[0]; }
  simulation::ScriptedDevice& instrument() { return by_mouse_[1]; }

 private:
  void Begin(Hands* hands);
  void Tell(Hands* hands, double until) noexcept;
  void TakeNews();

  // By pointer, since the servo refers to them and this is moved.
  std::unique_ptr<simulation::Session> session_;
  std::array<simulation::ScriptedDevice, 2> by_mouse_;  // by DeviceRole
  simulation::ServoWish wish_;
  simulation::Snapshot snapshot_;
  std::uint32_t buttons_ = 0;
  std::array<int, 2> episodes_{};  // of the hands' news
  double t_ = 0, pending_ = 0, peak_force_ = 0, running_ = 0;
  int next_presses_ = 0;
  bool has_thread_ = false;
  std::string servo_sentence_;
  const simulation::WorldPicture* tissues_ = nullptr;
  std::shared_ptr<HeldHands> held_;               // see Hands::Hold
  std::unique_ptr<simulation::ServoLoop> servo_;  // last: it uses the rest, and ends without force
};

// How both hands stand when a practice or an editor begins: the scope a third of the way in, the
// instrument's tip in the middle of its picture.
simulation::RodPose StartOfScope(const Scene& scene);
simulation::RodPose StartOfInstrument(const Scene& scene);
simulation::RodLimits ScopeLimits(const Scene& scene);
simulation::RodLimits InstrumentLimits(const Scene& scene);

}  // namespace arthro::app

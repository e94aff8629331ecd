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

#include "simulation/practice/hands/hands.h"
#include "simulation/practice/scripted_device.h"
#include "simulation/practice/servo_loop.h"

namespace arthro::simulation {

class Practice {
 public:
  // Takes a session over `scene`, with its tissues alive.
  Practice(std::unique_ptr<Session> session, const Scene& scene);

  // Runs the session for `seconds` more, or takes over what its thread did meanwhile; the hands
  // move evenly to where they are now. A pause longer than kLongestPause is not made up for: the
  // session then stood still. `hands`: what holds them, from the first call on, and must outlive
  // this; without, mouse and keys do. Where a device does not say where its hand is, that goes on
  // from where it was.
  void Advance(double seconds, Hands* hands = nullptr);
  static constexpr double kLongestPause = 0.1;  // s

  // As of the last Advance.
  const Snapshot& snapshot() const { return snapshot_; }
  double incision_spacing() const { return wish_.incision_spacing; }
  double view_angle() const { return wish_.view_angle; }
  void SetViewAngle(double view_angle) { wish_.view_angle = view_angle; }

  // Living tissues as of the last Advance; nullptr: none lives.
  const WorldPicture* tissues() const { return tissues_; }
  void ResetTissues();
  ToolKind instrument_kind() const { return wish_.instrument; }
  void SetInstrument(ToolKind kind) { wish_.instrument = kind; }
  // How a hand's device is mounted, from now on: its incision was calibrated.
  void SetMount(DeviceRole role, const DeviceRig& mount);
  // The button under the finger: jaws close, a shaver runs.
  void Press(bool is_pressed) { buttons_ = is_pressed ? 1u : 0u; }
  double blade_turn() const;  // of the shaver, rad

  double peak_force() const { return peak_force_; }  // N, largest on the instrument's tip so far
  // What about its thread went less than well; empty: nothing.
  const std::string& servo_sentence() const { return servo_sentence_; }

  // Where mouse and keys have the hands.
  ScriptedDevice& scope() { return by_mouse_[0]; }
  ScriptedDevice& instrument() { return by_mouse_[1]; }

 private:
  void Begin(Hands* hands);
  void Tell(Hands* hands, double until) noexcept;
  void TakeNews();

  // By pointer, since the servo refers to them and this is moved.
  std::unique_ptr<Session> session_;
  std::array<ScriptedDevice, 2> by_mouse_;  // by DeviceRole
  ServoWish wish_;
  Snapshot snapshot_;
  std::uint32_t buttons_ = 0;
  std::array<int, 2> episodes_{};  // of the hands' news
  double t_ = 0, pending_ = 0, peak_force_ = 0, running_ = 0;
  int next_presses_ = 0;
  bool has_thread_ = false;
  std::string servo_sentence_;
  const WorldPicture* tissues_ = nullptr;
  std::shared_ptr<HeldHands> held_;   // see Hands::Hold
  std::unique_ptr<ServoLoop> servo_;  // last: it uses the rest, and ends without force
};

// How both hands stand when a practice or an editor begins: the scope a third of the way in, the
// instrument's tip in the middle of its picture.
RodPose StartOfScope(const Scene& scene);
RodPose StartOfInstrument(const Scene& scene);
RodLimits ScopeLimits(const Scene& scene);
RodLimits InstrumentLimits(const Scene& scene);

}  // namespace arthro::simulation

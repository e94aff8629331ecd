// A practice session driven by mouse and keys: scripted hands, and the session ticked in 1 ms steps
// as often as time has passed. Where no force device is there is no servo thread; the modules are
// those that one would run.
#pragma once

#include <vector>

#include "authoring/project/document.h"
#include "simulation/session/scripted_device.h"
#include "simulation/session/session.h"
#include "simulation/tissue/body/tissue_preset.h"

namespace arthro::app {

class Practice {
 public:
  // Throws Error where the scene cannot be practised: no panorama, a material that is not among
  // the presets. Builds the depth field, the tissues' trees and their elements, which takes a
  // moment: make it in a job. Tissues that deform step on a thread of their own, or, so that the
  // same input gives the same pictures, inline.
  Practice(const authoring::Document& document,
           const std::vector<simulation::TissuePreset>& presets, simulation::TissuePace pace);

  // Runs the session for `seconds` more; the hands move evenly to where they are now. A pause
  // longer than kLongestPause is not made up for: the session then stood still.
  void Advance(double seconds);
  static constexpr double kLongestPause = 0.1;  // s

  const simulation::Snapshot& snapshot() const { return session_.snapshot(); }
  double incision_spacing() const { return session_.incision_spacing(); }
  double view_angle() const { return session_.view_angle(); }
  void SetViewAngle(double view_angle) { session_.SetViewAngle(view_angle); }

  // Living tissues as of the last Advance; nullptr: none lives.
  const simulation::WorldPicture* tissues() const { return tissues_; }
  void ResetTissues() { session_.ResetTissues(); }
  simulation::ToolKind instrument_kind() const { return session_.instrument(); }
  void SetInstrument(simulation::ToolKind kind) { session_.SetInstrument(kind); }
  // The button under the finger: jaws close, a shaver runs.
  void Press(bool is_pressed) { instrument_.SetButtons(is_pressed ? 1u : 0u); }
  double blade_turn() const { return blade_turn_; }  // of the shaver, rad

  double peak_force() const { return peak_force_; }  // N, largest on the instrument's tip so far

  simulation::ScriptedDevice& scope() { return scope_; }
  simulation::ScriptedDevice& instrument() { return instrument_; }

 private:
  simulation::Session session_;
  simulation::ScriptedDevice scope_, instrument_;
  double t_ = 0, pending_ = 0, peak_force_ = 0, blade_turn_ = 0;
  const simulation::WorldPicture* tissues_ = nullptr;
};

// How both hands stand when a practice or an editor begins: the scope a third of the way in, the
// instrument's tip in the middle of its picture.
simulation::RodPose StartOfScope(const Scene& scene);
simulation::RodPose StartOfInstrument(const Scene& scene);
simulation::RodLimits ScopeLimits(const Scene& scene);
simulation::RodLimits InstrumentLimits(const Scene& scene);

}  // namespace arthro::app

// Touch of a probe on the relief: distance and normal of the surface, stiffness, and the force that
// the session would give to the hand. A practice session computes it, with its contact
// and its limiter, so that the preview is the practice. Portal frame; m, N.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "app/state/editor_state.h"
#include "authoring/alignment/scene_point.h"
#include "simulation/practice/session.h"

namespace arthro::app {

struct TouchReading {
  double range = 0;         // m, from the portal
  glm::dvec3 point{0.0};    // on the relief
  glm::dvec3 normal{0.0};   // unit, into free space; zero: the probe feels nothing
  double stiffness = 0;     // N/m, force on the tip over penetration
  double force = 0;         // N, on the hand, after the lever and the limiter
  double tip_force = 0;     // N, on the tip
  bool is_reached = false;  // the probe comes to the point; false: its rod meets something first
};

// A session with the tissues as rigid surfaces, whose instrument is led by the preview.
class TouchProbe {
 public:
  TouchProbe(const LoadedScene& scene, const simulation::SessionOptions& options);

  // Leads the instrument from its portal to the point, presses it `press` m below the surface and
  // holds it until the limiter has let the whole force through.
  TouchReading Press(const glm::dvec3& point, double press);

 private:
  void Lead(const glm::dvec3& tip, int ticks);

  simulation::Session session_;
  DeviceRig rig_;
  glm::dvec3 portal_{0.0}, tip_{0.0};
  int settled_ = 0;  // ticks
  double t_ = 0;     // s
};

// Preview of the touch under the pointer.
struct TouchPreview {
  bool is_on = false;
  double press = 1e-3;  // m
  std::shared_ptr<TouchProbe> probe;
  std::shared_ptr<const DepthMap> depth;  // depth map of the probe
  std::optional<TouchReading> reading;
};

void ToggleTouch(EditorState& state);
bool TouchesRelief(const EditorState& state);
// Makes the probe anew after a change of the depth map, in a job. Once a frame.
void KeepTouchFresh(EditorState& state, const simulation::SessionOptions& options);
// Reads the touch where a line of sight meets the relief.
void TouchAlong(EditorState& state, const authoring::Sight& sight);
std::string WordsOfTouch(const TouchReading& reading);

}  // namespace arthro::app

// Touch of a probe on the relief or on a tissue in front of it: distance and normal of the surface,
// stiffness, and the force that the session would give to the hand. A practice session computes it,
// with its contact and its limiter, so that the preview is the practice. A tissue yields as a flat
// end of the probe's radius finds it: a half space [Sneddon 1965], or a thin layer on bone
// (elastic_layer.h). Portal frame; m, N.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/state/editor_state.h"
#include "authoring/alignment/scene_point.h"
#include "simulation/haptics/surface/surface_bvh.h"
#include "simulation/practice/session.h"

namespace arthro::app {

struct TouchReading {
  double range = 0;         // m, from the portal
  glm::dvec3 point{0.0};    // on the surface
  int tissue = -1;          // whose surface it is; -1: the relief
  glm::dvec3 normal{0.0};   // unit, into free space; zero: the probe feels nothing
  double stiffness = 0;     // N/m, force on the tip over penetration
  double force = 0;         // N, on the hand, after the lever and the limiter
  double tip_force = 0;     // N, on the tip
  bool is_reached = false;  // the probe comes to the point; false: its rod meets something first
};

// Force over depth of the probe's end on each tissue, N/m; 0 for a material without a preset.
std::vector<double> TipStiffness(const Scene& scene,
                                 const std::vector<simulation::TissuePreset>& presets);

// A session with the tissues as rigid surfaces, whose instrument is led by the preview.
class TouchProbe {
 public:
  // `stiffness`: of each tissue; none: they are rigid.
  TouchProbe(const LoadedScene& scene, const simulation::SessionOptions& options,
             std::vector<double> stiffness = {});

  // Leads the instrument from its portal to the point, presses it `press` m below the surface,
  // along the line from the portal of the scope, and holds it until the limiter has let the whole
  // force through.
  TouchReading Press(const glm::dvec3& point, double press);
  // The same on a tissue, along the normal of its surface.
  TouchReading PressTissue(const glm::dvec3& point, int tissue, const glm::dvec3& normal,
                           double press);

  // The first surface of a tissue along a line of sight, up to `range` m from its eye.
  struct TissueHit {
    int tissue = -1;
    glm::dvec3 point{0.0}, normal{0.0};
  };
  std::optional<TissueHit> TissueAlong(const authoring::Sight& sight, double range) const;

 private:
  void Lead(const glm::dvec3& tip, int ticks);
  TouchReading PressAlong(const glm::dvec3& point, const glm::dvec3& inwards, double press);

  simulation::Session session_;
  std::vector<simulation::SurfaceBvh> tissues_;
  std::vector<double> stiffness_;  // N/m
  double contact_ = 0;             // N/m, of the contact of the session
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
  // Parts of the scene that the probe was made of.
  std::shared_ptr<const DepthMap> depth;
  std::vector<Tissue> tissues;
  std::vector<SharedSurface> surfaces;
  std::optional<TouchReading> reading;
};

void ToggleTouch(EditorState& state);
bool TouchesRelief(const EditorState& state);
// Makes the probe anew after a change of the depth map or of a tissue, in a job. Once a frame.
void KeepTouchFresh(EditorState& state, const simulation::SessionOptions& options);
// Reads the touch where a line of sight meets the first tissue or the relief.
void TouchAlong(EditorState& state, const authoring::Sight& sight);
std::string WordsOfTouch(const EditorState& state, const TouchReading& reading);

}  // namespace arthro::app

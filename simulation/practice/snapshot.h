// State of the session after a servo tick, for the picture, the panels and the record. Portal
// frame, m, N, s. A plain value, copied whole through LatestValue.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "simulation/device/device_sample.h"
#include "simulation/haptics/output/fault.h"
#include "simulation/scope/camera_head.h"
#include "simulation/scope/disturbances.h"
#include "simulation/scope/rod_pose.h"
#include "simulation/tissue/contact/tool_shape.h"

namespace arthro::simulation {

inline constexpr int kNoContact = -1, kBackdropContact = 0;  // tissue i is 1 + i

struct ToolState {
  RodPose pose;                     // about the portal of the tool
  glm::dvec3 tip_in_portal{0.0};    // tip as the hand holds it
  glm::dvec3 proxy_in_portal{0.0};  // tip outside the surfaces; the tool is drawn here
  // Tip as deformable tissue sees it: moved by the push of the backdrop and the layers alone.
  glm::dvec3 tissue_tip_in_portal{0.0};
  // Force of the surfaces on the tip, as modelled: without limits, and ramped only after a change
  // of the instrument.
  glm::dvec3 tip_force{0.0};
  glm::dvec3 hand_force{0.0};  // force for the device, after the lever and the limits
  int contact = kNoContact;    // surface that carries most of the force
  double penetration = 0;      // m, depth of the tip below the surfaces
  int layer = -1;              // tissue in the scene of the thin layer in contact; −1: none
  double layer_depth = 0;      // m, depth of the deepest point in that layer
  bool is_layer_deep = false;  // deeper than the theory of a thin layer holds (elastic_layer.h)
  double shaft_held = 0;       // m, way of the tip by which a ridge of bone holds the shaft off it
  double shaft_through = 0;    // m, depth of the shaft in bone where no turn of the rod frees it
  glm::dvec2 pixel{0.0};       // scope: centre of its view; instrument: under its tip; NaN: none
  Fault fault = Fault::kNoSample;  // reason for a hand_force of zero
  double opening = 1;              // opening of the jaws, 0 closed; the first button closes them
  bool is_running = false;         // the shaver runs while the first button is held
};

struct Snapshot {
  double t = 0;  // s since the session began
  // Wishes as they were in this tick.
  double view_angle = 0, incision_spacing = 0;  // rad, m
  CameraHead head;
  Disturbances disturbances;
  ToolKind kind = ToolKind::kProbe;  // kind of the instrument
  ToolState scope, instrument;
};

inline const ToolState& ToolOf(const Snapshot& snapshot, DeviceRole role) noexcept {
  return role == DeviceRole::kScope ? snapshot.scope : snapshot.instrument;
}

}  // namespace arthro::simulation

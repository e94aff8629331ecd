// The session as it stands after a servo tick: what the picture, the panels and the record show.
// Portal frame, m, N, s. A plain value, copied whole through LatestValue.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "simulation/haptics/fault.h"
#include "simulation/scope/rod_pose.h"

namespace arthro::simulation {

inline constexpr int kNoContact = -1, kBackdropContact = 0;  // tissue i is 1 + i

struct ToolState {
  RodPose pose;                     // about the tool's own portal
  glm::dvec3 tip_in_portal{0.0};    // where the hand puts the tip
  glm::dvec3 proxy_in_portal{0.0};  // where the surfaces let it be: draw the tool here
  // Where living tissue has the hand: the tip, moved by what the backdrop alone pushes.
  glm::dvec3 tissue_tip_in_portal{0.0};
  // Force of the surfaces on the tip, as modelled: no limit, and no ramp but that of a new
  // instrument.
  glm::dvec3 tip_force{0.0};
  glm::dvec3 hand_force{0.0};  // what the device is told, after the lever and the limits
  int contact = kNoContact;    // of the surface that carries most of the force
  double penetration = 0;      // depth of the tip below the surfaces, m
  int layer = -1;              // thin layer that holds it: tissue of the scene; −1: none
  double layer_depth = 0;      // m, how deep its deepest point is there
  bool is_layer_deep = false;  // deeper in a thin layer than its theory holds (elastic_layer.h)
  glm::dvec2 pixel{0.0};       // scope: centre of its view; instrument: under its tip; NaN: none
  Fault fault = Fault::kNoSample;  // why hand_force is zero
  double opening = 1;              // of the jaws, 0 closed; the first button closes them
  bool is_running = false;         // the shaver, while the first button is held
};

struct Snapshot {
  double t = 0;  // s since the session began
  ToolState scope, instrument;
};

}  // namespace arthro::simulation

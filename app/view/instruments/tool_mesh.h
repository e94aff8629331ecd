// Drawn shapes of instruments, in the tool frame of simulation/tissue/contact/tool_shape.h: tip at
// the origin, +z along the rod into the joint, hook, window and moving jaw towards +y. The drawn
// shape agrees with the contact shape: the tips are equal, and no jaw reaches far beyond its
// capsules (tests/app/view prints it). m, rad.
//
// Sizes follow real ones: probes of 3 to 5 mm with a blunt hook and marks to measure by, hand
// instruments of 2.7 and 3.4 mm with jaws of about 2 mm [AORN instrument guide]; basket forceps
// whose moving tooth enters an open frame (US patent 5 389 104); shavers of two nested tubes, each
// with a toothed window, here of 4.5 mm [Gu et al. 2022]. The lower jaw of the grasper is fixed.
#pragma once

#include "simulation/scene/mesh/surface_mesh.h"
#include "simulation/tissue/contact/tool_shape.h"

namespace arthro::app {

struct ToolMesh {
  SurfaceMesh body, moving;  // moving jaw, or the shaver's blade; empty: nothing moves
  glm::dvec3 hinge{0.0}, axis{-1, 0, 0};
  double max_opening = 0;     // rad
  bool turns_freely = false;  // a rotating blade, not a jaw that opens
};

// Spacing of the rings along a shaft, so that its bent picture is smooth (probe_mesh.h).
inline constexpr double kToolRingSpacing = 0.5e-3;  // m

// The shaft ends `shaft_length` behind the tip.
ToolMesh MakeToolMesh(simulation::ToolKind kind, double ring_spacing = kToolRingSpacing,
                      double shaft_length = 0.13);

// Returns tool_from_moving: `opening` is 0 (closed) to 1, `turn` the blade's angle.
Pose MovingPart(const ToolMesh& mesh, double opening, double turn);

}  // namespace arthro::app

// Instruments as they are drawn, in the tool's frame of simulation/tissue/contact/tool_shape.h: the
// tip at the origin, +z along the rod into the joint, hook, window and moving jaw towards +y. What
// is drawn is where it touches: the tips are the shape's, and no jaw reaches far beyond its
// capsules (tests/app/view prints it). m, rad.
//
// As the real ones are made: probes of 3 to 5 mm with a blunt hook and marks to measure by, hand
// instruments of 2.7 and 3.4 mm with jaws of about 2 mm [AORN instrument guide]; basket forceps
// whose moving tooth comes down into an open frame (US patent 5 389 104); shavers as a tube in a
// tube, a toothed window in each, here of 4.5 mm [Gu et al. 2022]. The grasper's lower jaw stands
// still.
#pragma once

#include "simulation/scene/surface_mesh.h"
#include "simulation/tissue/contact/tool_shape.h"

namespace arthro::app {

struct ToolMesh {
  SurfaceMesh body, moving;  // the moving jaw, or the shaver's blade; empty: nothing moves
  glm::dvec3 hinge{0.0}, axis{-1, 0, 0};
  double max_opening = 0;     // rad
  bool turns_freely = false;  // a blade that runs, not a jaw that opens
};

// Rings along a shaft this close together keep its bent picture smooth (probe_mesh.h).
inline constexpr double kToolRingSpacing = 0.5e-3;  // m

// The shaft ends `shaft_length` behind the tip.
ToolMesh MakeToolMesh(simulation::ToolKind kind, double ring_spacing = kToolRingSpacing,
                      double shaft_length = 0.13);

// tool_from_moving: `opening` is 0 (closed) to 1, `turn` the blade's angle.
Pose MovingPart(const ToolMesh& mesh, double opening, double turn);

}  // namespace arthro::app

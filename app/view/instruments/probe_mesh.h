// Probe, made in code, in its own frame: +z runs along the rod into the joint, the hook bends
// towards +y, and the hook's outer side touches z = 0, where the proxy is. Metres.
#pragma once

#include "simulation/core/frames.h"
#include "simulation/scene/mesh/surface_mesh.h"

namespace arthro::app {

struct ProbeShape {
  double shaft_radius = 1.5e-3;   // 3 mm instrument
  double neck_radius = 0.75e-3;   // at the bend
  double point_radius = 0.45e-3;  // rounded end of the hook
  double taper_length = 9e-3;     // from shaft to neck
  double hook_length = 3.4e-3;    // from the axis to the hook's end, as of a usual probe
  double shaft_length = 0.12;     // longer than a joint is deep; cut at the portal when drawn
  // Spacing of the rings along the shaft, so that its bent picture is smooth: 0.2 px of chord error
  // in a 512 px window some 5 mm from the lens, falling with the square of the distance.
  double ring_spacing = 0.5e-3;
  int sides = 20;
};

SurfaceMesh MakeProbeMesh(const ProbeShape& shape = {});

// Returns portal_from_probe with the tip at the proxy, the rod from the instrument's portal, and
// the hook turned by roll from north towards east. The two points must differ.
Pose ProbePose(const glm::dvec3& portal, const glm::dvec3& proxy, double roll);

}  // namespace arthro::app

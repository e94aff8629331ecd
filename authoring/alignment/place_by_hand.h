// Placing a tissue by hand: small motions in the axes of the portal or of the tissue, its mirror
// image for the other knee, and its base laid onto the relief. m, rad; poses are
// portal_from_tissue.
#pragma once

#include <glm/vec3.hpp>

#include "authoring/alignment/relief_distance.h"
#include "simulation/scene/scene.h"
#include "simulation/scene/solids/solid.h"

namespace arthro::authoring {

enum class NudgeAxes { kPortal, kTissue };

// Moves a pose along an axis (0 to 2) by `distance`.
Pose Shifted(const Pose& pose, int axis, double distance, NudgeAxes axes);
// Turns a pose about an axis through `middle`, a point of the tissue's own frame.
Pose Turned(const Pose& pose, int axis, double angle, NudgeAxes axes, const glm::dvec3& middle);

// Middle of the box around a surface; the origin for an empty one.
glm::dvec3 MiddleOf(const SurfaceMesh& surface);

// Mean direction in which an open sheet faces, as a share of its area; zero for a closed surface.
glm::dvec3 FacingOf(const SurfaceMesh& surface);

// Mirror image in the plane x = `at` of the own frame. Its triangles face outwards again; balls,
// regions and cuts go with it.
SurfaceMesh Mirrored(SurfaceMesh surface, double at);
Tissue Mirrored(Tissue tissue, double at);
Solid Mirrored(Solid solid, double at);

// Pose whose base lies at `place` of the relief: a flat side touches it, and has the normal of the
// relief there, averaged over 2 mm. The turn is the smallest that does so.
Pose LaidOnRelief(const ReliefTarget& relief, const SurfaceMesh& surface, const Pose& present,
                  const glm::dvec3& place);

}  // namespace arthro::authoring

// Places of a tissue where its mesh is refined, as balls in the surface's own frame, m: whether
// they touch the tissue, and the edge length reached in them.
#pragma once

#include <span>
#include <string>

#include "authoring/tissue/surface/surface_check.h"
#include "simulation/scene/mesh/tet_mesh.h"
#include "simulation/scene/scene.h"

namespace arthro::authoring {

// Whether the surface, or the volume that it encloses, has a point in the ball.
bool Touches(const Ball& ball, const SurfaceMesh& surface);

// Throws Error(kBadArgument) for the first ball that is not finite, has no radius, or touches
// nothing. `what` names such a ball, as in "a place of --fine-at".
void RequireTouching(std::span<const Ball> balls, const SurfaceMesh& surface,
                     const std::string& what, const SurfaceSource& source);

// Returns the longest edge of the elements with a corner in the ball; 0 when there is none.
double LongestEdgeIn(const Ball& ball, const TetMesh& mesh);

}  // namespace arthro::authoring

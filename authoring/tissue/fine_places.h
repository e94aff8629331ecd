// Places of a tissue that its mesh is made finer for, as balls in the surface's own frame, m: which
// of them it touches at all, and how fine it became there.
#pragma once

#include <span>
#include <string>

#include "authoring/tissue/surface_check.h"
#include "simulation/scene/scene.h"
#include "simulation/scene/tet_mesh.h"

namespace arthro::authoring {

// Whether the surface, or the volume that it closes, has a point in the ball.
bool Touches(const Ball& ball, const SurfaceMesh& surface);

// Throws Error(kBadArgument) for the first ball that is not a number, has no radius, or touches
// nothing. `what` names one of them: "a place of --fine-at".
void RequireTouching(std::span<const Ball> balls, const SurfaceMesh& surface,
                     const std::string& what, const SurfaceSource& source);

// Of the elements with a corner in the ball; 0: there is none.
double LongestEdgeIn(const Ball& ball, const TetMesh& mesh);

}  // namespace arthro::authoring

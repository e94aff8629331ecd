// Loose body as it is drawn: a ball of pale cartilage with the dents of a body that has grown in
// the joint. It lies within the ball that is simulated
// (simulation/training/observe/loose_bodies.h). Own frame: the middle of the ball; m.
#pragma once

#include "simulation/scene/mesh/surface_mesh.h"
#include "simulation/scene/scene.h"
#include "simulation/tissue/body/tissue_look.h"

namespace arthro::app {

// Largest depth of a dent, a share of the radius.
inline constexpr double kDeepestDent = 0.14;

// `number`: bodies with different numbers have different dents.
SurfaceMesh MakeLooseBody(double radius, int number);
// Colour of a body, at this place.
Tissue LooseBodyTissue(const Ball& ball);
simulation::TissueLook LooseBodyLook();

}  // namespace arthro::app

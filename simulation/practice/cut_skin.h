// A tissue as its author's cuts leave it, for pictures while no session runs: the same skin that a
// session begins with.
#pragma once

#include "simulation/scene/scene.h"
#include "simulation/scene/surface_mesh.h"
#include "simulation/tissue/body/deformable_body.h"
#include "simulation/tissue/field/solid_field.h"

namespace arthro::simulation {

// With cuts that are made: some, and tetrahedra to make them in.
bool HasCutsMade(const Tissue& tissue);

// The whole tissue, in the frame of its body; the longest part of it, so that who cuts again keeps
// it. Throws Error(kBadMesh) for a surface that is empty or open.
SolidField WholeField(const Tissue& tissue, const SurfaceMesh& surface);

// In the tissue's own frame. Throws Error, as MakeCuts does, with the tissue's name.
BodySkin CutSkin(const Tissue& tissue, const SurfaceMesh& surface, const SolidField& whole);
BodySkin CutSkin(const Tissue& tissue, const SurfaceMesh& surface);

}  // namespace arthro::simulation

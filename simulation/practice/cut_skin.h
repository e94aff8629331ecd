// Skin of a tissue after its author's cuts, for pictures while no session runs. A session begins
// with the same skin.
#pragma once

#include "simulation/scene/mesh/surface_mesh.h"
#include "simulation/scene/scene.h"
#include "simulation/tissue/body/deformable_body.h"
#include "simulation/tissue/field/solid_field.h"

namespace arthro::simulation {

// True where the tissue has cuts, and tetrahedra in which to make them.
bool HasCutsMade(const Tissue& tissue);

// Field of the uncut tissue, in the frame of its body. It takes most of the time of CutSkin, so
// keep it to cut again. Throws Error(kBadMesh) for a surface that is empty or open.
SolidField WholeField(const Tissue& tissue, const SurfaceMesh& surface);

// Skin in the frame of the tissue. Throws Error as MakeCuts does, with the name of the tissue.
BodySkin CutSkin(const Tissue& tissue, const SurfaceMesh& surface, const SolidField& whole);
BodySkin CutSkin(const Tissue& tissue, const SurfaceMesh& surface);

}  // namespace arthro::simulation

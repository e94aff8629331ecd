// Share of a surface that the relief of a backdrop hides from the scope's portal: a tissue behind
// the relief is in no picture. m, portal frame.
#pragma once

#include "simulation/core/frames.h"
#include "simulation/scene/image.h"
#include "simulation/scene/mesh/surface_mesh.h"
#include "simulation/scene/scene.h"

namespace arthro {

// 0 to 1, by vertices; 0 for a surface without any. A vertex is hidden where the line from the
// portal to it passes the relief first; nothing hides it where nothing was imaged. Without a depth
// map the bare sphere hides it.
double HiddenShare(const SurfaceMesh& surface, const Pose& portal_from_surface,
                   const DepthMap& depth, const Backdrop& backdrop);

}  // namespace arthro

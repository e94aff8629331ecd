// Share of a surface that the relief of a backdrop hides from the scope's portal: a tissue behind
// the relief is in no picture. m, portal frame.
#pragma once

#include "simulation/core/frames.h"
#include "simulation/scene/image.h"
#include "simulation/scene/scene.h"
#include "simulation/scene/surface_mesh.h"

namespace arthro {

// Relief in a direction from the portal, from the nearest pixel: 0 without a depth map, NaN where
// nothing was imaged.
double ReliefTowards(const glm::dvec3& direction, const DepthMap& depth, const Backdrop& backdrop);

// 0 to 1, by vertices; 0 for a surface without any. A vertex is hidden where the line from the
// portal to it passes the relief first; nothing hides it where nothing was imaged. Without a depth
// map the bare sphere hides it.
double HiddenShare(const SurfaceMesh& surface, const Pose& portal_from_surface,
                   const DepthMap& depth, const Backdrop& backdrop);

}  // namespace arthro

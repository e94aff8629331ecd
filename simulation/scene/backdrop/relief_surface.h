// Relief of a backdrop as a triangle surface in the portal frame, for pictures from outside and for
// contact with bodies that are wide against its pixels. m; the front faces the portal.
#pragma once

#include <vector>

#include <glm/vec2.hpp>

#include "simulation/scene/image.h"
#include "simulation/scene/mesh/surface_mesh.h"
#include "simulation/scene/scene.h"

namespace arthro {

enum class ReliefSample {
  kAtCorner,  // the pixel at the corner of a cell
  kHighest    // the pixel of the cells around that is nearest to the portal
};

struct ReliefSurface {
  SurfaceMesh mesh;
  std::vector<glm::dvec2> pixel;  // place of each vertex in the depth map
};

// Grid of at most `cells` cells along the longer side of a picture of width x height, with holes
// where nothing was imaged. Without a depth map: the bare sphere.
ReliefSurface MakeReliefSurface(int width, int height, const DepthMap& depth,
                                const Backdrop& backdrop, int cells, ReliefSample sample);

}  // namespace arthro

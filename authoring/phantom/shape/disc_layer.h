// Closed surface of two discs with the same plan, and the wall between their rims. A disc has rings
// of points around its middle: ring k has 6k points, so that its triangles are even.
#pragma once

#include <functional>

#include <glm/vec3.hpp>

#include "simulation/scene/mesh/surface_mesh.h"

namespace arthro::authoring {

// Point of a disc: `share` is 0 in the middle, `angle` in rad runs counter-clockwise seen from
// above.
using DiscPlace = std::function<glm::dvec3(double share, double angle, bool is_top)>;

// `rim` is the share at the rim. The top's points come first, then the bottom's, from the middle
// outwards.
SurfaceMesh DiscLayer(int rings, double rim, const DiscPlace& place);

}  // namespace arthro::authoring

// Guess of the unit of a surface file, which states none, from its size: a model of a joint is some
// millimetres to some centimetres long.
#pragma once

#include <string>

#include "simulation/scene/mesh/surface_mesh.h"

namespace arthro::authoring {

// Longest side of the box about the surface, in the unit of its vertices; 0 where there are none.
double LongestSide(const SurfaceMesh& surface);

// The first of "mm", "m", "cm", "in" and "um" in which `longest_side` is the length of a model of a
// joint, 4 to 150 mm; "mm" where none is.
std::string LikelyUnit(double longest_side);

}  // namespace arthro::authoring

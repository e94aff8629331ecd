// From a sheet to a layer: scans give only the joint surface of a cartilage, and its thickness is
// known from elsewhere.
#pragma once

#include "authoring/tissue/surface/surface_repair.h"

namespace arthro::authoring {

// Adds to each open part a back side at `thickness` metres behind its triangles (in front of them
// when negative), along the mean normal at each vertex, and a wall along its rim. Closed parts
// stay. Returns the number of thickened parts. New triangles have no source (-1).
int ThickenOpenParts(RepairedSurface& surface, double thickness);

}  // namespace arthro::authoring

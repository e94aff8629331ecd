// From a sheet to a layer: scans give the joint surface of a cartilage only, and its thickness is
// known from elsewhere.
#pragma once

#include "authoring/tissue/surface_repair.h"

namespace arthro::authoring {

// Gives each open part a back side at `thickness` metres behind its triangles (before them when
// negative), along the mean normal at each vertex, and a wall along its rim. Closed parts stay.
// Returns how many parts were thickened. New triangles have no source (-1).
int ThickenOpenParts(RepairedSurface& surface, double thickness);

}  // namespace arthro::authoring

// Corrects the skin of a cut tissue by the surface that the tissue had before. The skin comes from
// a grid, which makes thin edges lumpy; away from cuts it is projected onto the uncut surface and
// relaxed along it, so that vertices are spread evenly. m, the surface's own frame.
#pragma once

#include <cstdint>
#include <span>

#include "simulation/scene/surface_finder.h"
#include "simulation/scene/surface_mesh.h"
#include "simulation/tissue/field/solid_field.h"

namespace arthro::simulation {

// Projects the vertices of a field's skin that lie well away from a cut onto the surface, and
// relaxes the others by less than half a spacing; only flagged vertices are moved (empty: all).
void LayOnto(const SurfaceFinder& uncut, const SolidField& field,
             std::span<const std::uint8_t> is_new, SurfaceMesh& skin);

}  // namespace arthro::simulation

// Surface of a tissue before any cut. The skin of the remaining tissue comes from a grid, which
// makes thin edges lumpy. Away from cuts it is projected back onto this surface and relaxed along
// it, so that vertices are evenly spaced. m, the surface's own frame.
#pragma once

#include <cstdint>
#include <span>

#include "simulation/scene/surface_finder.h"
#include "simulation/scene/surface_mesh.h"
#include "simulation/tissue/field/solid_field.h"

namespace arthro::simulation {

// Projects the vertices of a field's skin that lie well away from cuts onto the surface. Smooths
// the others by less than half a spacing. Moves flagged vertices only (empty: all).
void ProjectOnto(const SurfaceFinder& uncut, const SolidField& field,
                 std::span<const std::uint8_t> is_new, SurfaceMesh& skin);

}  // namespace arthro::simulation

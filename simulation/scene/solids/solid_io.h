// Solids (solid.h) from and to files, arthroscene.solid/1: JSON by the fields that solid.h lists,
// ending .solid, m and degrees. Faults are Error(kBadMesh): one sentence with the key.
#pragma once

#include <filesystem>
#include <string>

#include "simulation/scene/mesh/surface_mesh.h"
#include "simulation/scene/solids/solid.h"

namespace arthro {

// True for a name that ends in .solid.
bool IsSolidFile(const std::filesystem::path& file);

// Throws for unknown keys and words, numbers out of range, and all that FaultOfSolid names.
Solid ParseSolid(const std::string& text, const std::filesystem::path& file = {});
Solid ReadSolid(const std::filesystem::path& file);
std::string JsonFromSolid(const Solid& solid);
void WriteSolid(const std::filesystem::path& file, const Solid& solid);
// The schema for other tools, resources/schemas/solid-1.schema.json.
std::string SolidSchemaText();

// Grid cells along the longest side of a solid's box: the surface of a ball is then less than 0.1 %
// of its radius off.
inline constexpr int kSolidCells = 48;

// Closed triangle surface of the solid, for pictures, tetrahedra and checks: VTK's contour on a
// grid, each vertex moved onto the zero of the function. Sharp edges are cut off by up to half a
// cell. Throws Error(kBadMesh) where nothing is left of the solid.
SurfaceMesh SurfaceOfSolid(const Solid& solid, int cells = kSolidCells);

}  // namespace arthro

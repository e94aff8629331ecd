// Meshes to and from files. Surfaces: STL (text and binary), OBJ, PLY, OFF and VTP are read, PLY,
// STL, OBJ and VTP are written. Volumes: VTU with VTK_TETRA or VTK_QUADRATIC_TETRA cells, whose 0/1
// point arrays are the sets. Files say nothing of their unit, so it is declared on reading; what is
// written is in metres. Every fault is Error(kBadMesh): one sentence, with the line or index.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "simulation/scene/mesh/surface_mesh.h"
#include "simulation/scene/mesh/tet_mesh.h"

namespace arthro {

// Changes that were made on reading a surface.
struct SurfaceReadReport {
  int merged_vertices = 0;        // lay exactly on another one: STL soups, texture seams
  int degenerate_triangles = 0;   // dropped: two corners on one point
  int unreferenced_vertices = 0;  // dropped: in no polygon
  int polygons_split = 0;         // had four corners or more
};

// Format by extension. Vertices in the file times `metres_per_unit`; exactly equal vertices become
// one, polygons become triangles, in the order of the file.
SurfaceMesh ReadSurface(const std::filesystem::path& file, double metres_per_unit,
                        SurfaceReadReport* report = nullptr);

// Numbers of the vertices by name, such as the zone of each.
using SurfaceLabels = std::map<std::string, std::vector<std::uint8_t>>;

// .ply (binary, 64-bit), .obj (text, exact), .stl (binary, 32-bit as the format has it) or .vtp
// (64-bit, the only one that holds labels); atomically.
void WriteSurface(const std::filesystem::path& file, const SurfaceMesh& surface,
                  const SurfaceLabels& labels = {});

// Changes that were made on reading a volume, one sentence each: nodes of no element, duplicate
// nodes and elements, inverted elements, and slivers that make solving harder.
struct TetReadReport {
  std::vector<std::string> messages;
};

// All elements of one order. Elements come out positive (tet_mesh.h); one without volume is
// refused.
TetMesh ReadTetMesh(const std::filesystem::path& file, TetReadReport* report = nullptr);

// Inline base64 of 64-bit floats: the same mesh gives the same bytes, and reading gives the same
// bits. Atomic; "-" is standard output.
void WriteTetMesh(const std::filesystem::path& file, const TetMesh& mesh);

}  // namespace arthro

// Polygons as a surface file lists them, before they are a surface: corners may repeat, polygons
// may have any number of corners. Coordinates in the file's own unit.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "simulation/scene/mesh/mesh_io.h"
#include "simulation/scene/mesh/surface_mesh.h"

namespace arthro {

struct PolygonSoup {
  std::vector<glm::dvec3> points;      // in the file's unit
  std::vector<int> corners;            // indices into points, polygon after polygon
  std::vector<int> polygon_ends = {};  // one past the last corner of each polygon

  void ClosePolygon() { polygon_ends.push_back(static_cast<int>(corners.size())); }
};

// The formats, from the bytes of a whole file; `file` is for the sentence only. Throw
// Error(kBadMesh).
PolygonSoup ParseStl(std::string_view bytes, const std::filesystem::path& file);
PolygonSoup ParseObj(std::string_view bytes, const std::filesystem::path& file);
PolygonSoup ParseOff(std::string_view bytes, const std::filesystem::path& file);
PolygonSoup ParsePly(std::string_view bytes, const std::filesystem::path& file);
PolygonSoup ParseVtp(std::string_view bytes, const std::filesystem::path& file);

// Text of a VTP file, in metres, with the labels as point arrays.
std::string VtpBytes(const SurfaceMesh& surface, const SurfaceLabels& labels);

// Welds, triangulates and scales. Refuses a coordinate that is not finite, a corner that names no
// point, and a soup without a triangle.
SurfaceMesh SurfaceFromPolygons(const PolygonSoup& soup, double metres_per_unit,
                                const std::filesystem::path& file, SurfaceReadReport* report);

}  // namespace arthro

// Checks whether a surface can be filled with tetrahedra: closed, manifold, facing outwards, free
// of self-intersections, and of a size that a tissue can have.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "simulation/core/progress.h"
#include "simulation/scene/mesh/surface_mesh.h"

namespace arthro::authoring {

// Count of a fault, and its first place.
struct Finding {
  int count = 0;
  glm::dvec3 where{0.0};  // m
  std::array<int, 2> triangles{-1, -1};

  void Add(const glm::dvec3& x, int s, int t = -1) {
    if (count++ == 0) where = x, triangles = {s, t};
  }
};

struct SurfaceCheck {
  int vertices = 0, triangles = 0, components = 0;
  glm::dvec3 low{0.0}, high{0.0};  // m
  double area = 0;                 // m²
  double volume = 0;               // m³, signed
  Finding degenerate;              // triangles without area
  Finding duplicate;               // triangles on the same three corners as another one
  Finding open_edges;              // sides without a neighbour
  Finding nonmanifold_edges;       // edges of more than two triangles
  Finding nonmanifold_vertices;    // corners at which two sheets touch
  Finding flipped;                 // neighbours that face opposite ways
  Finding inward;                  // components that face inwards
  Finding cavities;                // components inside another one
  Finding self_intersections;      // pairs of triangles
  // Components with less than 1e-3 of the largest one's volume: debris of a segmentation.
  Finding tiny_components;

  double Diagonal() const;  // diagonal of the bounding box, m
  bool IsClosedManifold() const {
    return degenerate.count + duplicate.count + open_edges.count + nonmanifold_edges.count +
               nonmanifold_vertices.count ==
           0;
  }
};

// Searches self-intersections and cavities only in a closed manifold.
SurfaceCheck CheckSurface(const SurfaceMesh& surface, const Progress& progress = {});

// Origin of a surface, so that a message can give places in the user's terms.
struct SurfaceSource {
  std::filesystem::path file;
  std::string unit = "m";
  double metres_per_unit = 1.0;
  std::vector<int> triangle_in_file;  // per triangle, its number in the file; empty: the same
};

// Throws Error(kBadMesh) in one sentence: the first fault that makes a volume impossible, its
// count, its place in the file's unit, and what to do.
void RequireMeshable(const SurfaceCheck& check, const SurfaceSource& source);

// Throws Error(kBadMesh) when no tissue has this size, and names the unit that would fit.
void RequireTissueSize(const SurfaceCheck& check, const SurfaceSource& source);

}  // namespace arthro::authoring

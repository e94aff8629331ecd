// Skin of a tissue from which parts were removed: the triangles of the whole surface, clipped where
// the cuts meet them, and the faces of the cuts. A triangle that no cut comes near keeps its
// corners and its order. Along the lips a face of a cut passes through the surface by a tenth of a
// spacing, so that no gap is visible; they share no vertex, so that the edge stays sharp. m.
#pragma once

#include <cstdint>
#include <vector>

#include "simulation/scene/mesh/surface_finder.h"
#include "simulation/scene/mesh/surface_mesh.h"
#include "simulation/tissue/field/polygonise.h"
#include "simulation/tissue/field/solid_field.h"

namespace arthro::simulation {

struct CarvedSkin {
  SurfaceMesh surface;
  std::vector<std::uint8_t> is_fresh;  // 1 per vertex on the face of a cut
  std::vector<int> whole_vertex;       // index in the whole surface per vertex; −1: a new vertex
};

class SkinCarver {
 public:
  // `whole`: the closed surface that `field`, which is not yet cut, was made from.
  SkinCarver(SurfaceMesh whole, SolidField field);
  // Triangles beside a cut are divided to about the field's spacing, along a curved surface where
  // the whole surface is smooth. Keeps the faces of the cuts for the next call, which makes those
  // anew that changed; the result is the same.
  CarvedSkin Carve(const SolidField& field);

 private:
  // Returns the distance from the whole surface, positive outside: exact within a spacing of it,
  // and otherwise that of the field.
  double DistanceFromWhole(const glm::dvec3& x) const;

  SurfaceMesh whole_;
  SolidField field_of_whole_;
  std::vector<glm::dvec3> normals_, smooth_normals_;  // the latter zero at creases
  SurfaceFinder finder_;
  FieldSkin faces_;              // faces of the cuts, as they were last
  std::vector<double> outside_;  // DistanceFromWhole per vertex of faces_
};

}  // namespace arthro::simulation

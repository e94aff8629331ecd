// The surface of a field as triangles, kept up to date as the field is cut. Each patch of the
// surface in a cell gives one vertex, pulled onto the zero of the trilinear interpolation; each
// grid edge that the surface crosses gives two triangles (dual marching cubes: Nielson 2004). The
// result is closed, consistently outward and a manifold: every edge has two triangles, every
// vertex one fan. m.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "simulation/scene/surface_mesh.h"
#include "simulation/tissue/field/solid_field.h"

namespace arthro::simulation {

struct SkinUpdate {
  int bricks_redone = 0;     // vertices computed anew
  long cells_redone = 0;     // of those bricks
  int bricks_relinked = 0;   // triangles alone anew: they lie beside one of those
  int bricks_with_skin = 0;  // in all
};

class FieldSkin {
 public:
  FieldSkin() = default;
  explicit FieldSkin(const SolidField& field) { Update(field); }

  // Redoes the bricks whose surface changed since the last call. A field of another grid is begun
  // anew; so is one with a lower version().
  SkinUpdate Update(const SolidField& field);

  const SurfaceMesh& surface() const { return surface_; }
  // Which vertex of the surface before the last Update each vertex was, unmoved; −1: it is new.
  std::span<const int> previous() const { return previous_; }

 private:
  struct Corner {
    int brick, vertex;
  };
  struct Brick {
    std::vector<glm::dvec3> vertices;
    std::vector<std::array<Corner, 4>> quads;
    std::vector<std::int16_t> first_vertex;  // a cell; empty: no surface in this brick
    int touching_faces = 0;  // sides on which a cell at the border touches itself (cell_patches.h)
    int first = 0;           // of its vertices in surface_
  };
  class Cells;

  SurfaceMesh surface_;
  std::vector<int> previous_;
  std::vector<Brick> bricks_;
  FieldGrid grid_;
  std::uint64_t version_ = 0;
};

// 1 a vertex of `skin` on a face that edits of the field made, 0 on one that was there before.
std::vector<std::uint8_t> FreshVertices(const SurfaceMesh& skin, const SolidField& field);

inline SurfaceMesh Polygonise(const SolidField& field) { return FieldSkin(field).surface(); }

}  // namespace arthro::simulation

// Triangle surface of a field, kept up to date while the field is cut. Each patch of the surface in
// a cell gives one vertex, moved onto the zero of the trilinear interpolation. Each grid edge that
// the surface crosses gives two triangles (dual marching cubes: Nielson 2004). The result is a
// closed, outward-oriented manifold: every edge has two triangles, every vertex one fan. m.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "simulation/scene/mesh/surface_mesh.h"
#include "simulation/tissue/field/solid_field.h"

namespace arthro::simulation {

struct SkinUpdate {
  int bricks_redone = 0;     // vertices computed again
  long cells_redone = 0;     // cells in those bricks
  int bricks_relinked = 0;   // neighbours of redone bricks: only triangles rebuilt
  int bricks_with_skin = 0;  // total
};

class FieldSkin {
 public:
  FieldSkin() = default;
  explicit FieldSkin(const SolidField& field) { Update(field); }

  // Rebuilds the bricks whose surface changed since the last call. Starts again for a field with
  // another grid or a lower version().
  SkinUpdate Update(const SolidField& field);
  // The same for the surface of other values on the field's grid, negative inside. It may end at
  // the sides of the grid, and is then open there. Keeps a copy of the values to find the bricks
  // that changed; a skin is updated by one of both functions only.
  SkinUpdate Update(const SolidField& field, std::span<const float> values);

  const SurfaceMesh& surface() const { return surface_; }
  // Index that each vertex had before the last Update, if it has not moved; −1: new vertex.
  std::span<const int> previous() const { return previous_; }

 private:
  struct Corner {
    int brick, vertex;
  };
  struct Brick {
    std::vector<glm::dvec3> vertices;
    std::vector<std::array<Corner, 4>> quads;
    std::vector<std::int16_t> first_vertex;  // per cell; empty: no surface in this brick
    int touching_faces = 0;  // sides on which a border cell touches itself (cell_patches.h)
    int first = 0;           // index of its first vertex in surface_
  };
  class Cells;

  bool HasGridOf(const SolidField& field) const;
  // `has_changed`: of brick (i, j, k); not asked where the skin is new.
  template <class HasChanged>
  SkinUpdate UpdateBricks(const SolidField& field, std::span<const float> values, bool is_new,
                          const HasChanged& has_changed);

  SurfaceMesh surface_;
  std::vector<int> previous_;
  std::vector<Brick> bricks_;
  FieldGrid grid_;
  std::uint64_t version_ = 0;
  std::vector<float> values_;  // values of the last update by others
};

inline SurfaceMesh Polygonise(const SolidField& field) { return FieldSkin(field).surface(); }

}  // namespace arthro::simulation

// Which part of space is solid, as a sampled signed distance (negative inside) on a regular grid of
// float values in bricks: the shape of a tissue at rest, of which bites and shavings are taken by
// Boolean subtraction, and the implicit-function tissue of paper 3.4. The surface that it stands
// for is the zero of its trilinear interpolation; its resolution is the grid's spacing. m. Queries
// are noexcept and allocate nothing; edits touch only the bricks they change.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include <glm/vec3.hpp>

#include "simulation/scene/surface_mesh.h"

namespace arthro::simulation {

struct Box3 {
  glm::dvec3 low{0.0}, high{0.0};
};

struct FieldEdit {
  double removed = 0;  // m³ that were solid and are not any more (sub-cell)
  Box3 changed;        // empty (low > high): nothing changed
};

class SolidField {
 public:
  // Distance to a closed surface. `spacing`: of the grid, m. Throws Error(kBadMesh) for an empty
  // surface and Error(kBadArgument) for a grid of more than `max_cells`.
  static SolidField FromSurface(const SurfaceMesh& surface, double spacing,
                                std::int64_t max_cells = 20'000'000);
  // From a function, over a box.
  static SolidField FromFunction(const Box3& box, double spacing,
                                 const std::function<double(const glm::dvec3&)>& distance,
                                 std::int64_t max_cells = 20'000'000);

  double Distance(const glm::dvec3& x) const noexcept;      // clamped to ± band()
  glm::dvec3 Gradient(const glm::dvec3& x) const noexcept;  // of the trilinear interpolation
  double spacing() const;
  double band() const;  // m, beyond which distances are only a sign
  Box3 box() const;
  double Volume() const;  // m³ solid now

  // Takes away, within `box`, what lies where distance(x) < 0 (max(old, −distance)).
  FieldEdit Subtract(const Box3& box, const std::function<double(const glm::dvec3&)>& distance);
  // Puts back or adds (min(old, distance)).
  FieldEdit Add(const Box3& box, const std::function<double(const glm::dvec3&)>& distance);

  // Grows with every edit that changed something.
  std::uint64_t version() const;
  // (the rest is the implementer's: bricks, polygoniser and pieces are free functions over it)
};

}  // namespace arthro::simulation

// Casts rays from the portal to the deformable models in their poses in the scene. Portal frame, m.
#pragma once

#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "authoring/phantom/shape/cavity.h"
#include "simulation/scene/mesh/surface_mesh.h"

namespace arthro::authoring {

struct TissueHit {
  double distance = 0;
  glm::dvec3 normal{0.0};
  Surface surface = Surface::kMeniscus;
  double rim = 0;
};

class TissueCaster {
 public:
  // Adds a model in the portal frame. `rims` gives each vertex its place between free edge and
  // outer rim, and may be empty.
  void Add(const SurfaceMesh& mesh_in_portal, Surface surface, const std::vector<double>& rims);
  // Call once, after the last Add.
  void Sort();

  // Returns false when Cast is certain to find nothing.
  bool MayHit(const glm::dvec3& direction) const;
  std::optional<TissueHit> Cast(const glm::dvec3& direction) const;

  // Share of the light that reaches a point of the cavity beside a model: the contact shadow.
  double ShadeAt(Surface surface, const glm::dvec3& x) const;

 private:
  struct Corner {
    glm::dvec3 x{0.0}, normal{0.0};
    double rim = 0;
  };
  struct Triangle {
    int a, b, c;
    Surface surface;
  };
  std::vector<Corner> corners_;
  std::vector<Triangle> triangles_;
  std::vector<std::vector<int>> cells_;  // triangles by latitude and longitude
  std::vector<std::vector<int>> boxes_;  // triangles by position, for ShadeAt
};

}  // namespace arthro::authoring

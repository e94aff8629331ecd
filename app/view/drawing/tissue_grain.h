// Coordinates of a tissue's pattern, found from the shape of its whole surface at rest: along the
// fibres, across them and through the tissue. A pattern in these coordinates moves with the tissue,
// and goes on over the faces of cuts. m, the tissue's own frame.
//
// A crescent (TissueStructure::kFibres) is a plane by principal components and a circle by least
// squares in it [Kåsa 1976]; its edges are the smallest and largest
// radius per angle, its ends the borders of the largest gap of angles. A plate (kHyaline) has that
// plane and a border, where its surface turns away from the plane's normal.
#pragma once

#include <array>
#include <vector>

#include <glm/vec3.hpp>

#include "simulation/scene/mesh/crescent_fit.h"
#include "simulation/scene/mesh/surface_mesh.h"
#include "simulation/tissue/body/tissue_look.h"

namespace arthro::app {

struct GrainPoint {
  glm::dvec3 place{0.0};  // m: along the fibres, across them, through the tissue
  double rim = 0;         // crescent: 0 free edge to 1 rim; plate: 1 border to 0 within it
  double root = 0;        // crescent: 1 at its ends; plate: 1 where its surface is a side
};

class TissueGrain {
 public:
  TissueGrain() = default;  // the tissue's own coordinates
  TissueGrain(const SurfaceMesh& whole, simulation::TissueStructure structure);

  // `normal`: of the surface at rest there.
  GrainPoint At(const glm::dvec3& rest, const glm::dvec3& normal) const;
  // Direction of the fibres there, unit; zero for a tissue without fibres.
  glm::dvec3 Along(const glm::dvec3& rest) const;
  // Normal of the plane in which the tissue lies; zero for a plain tissue.
  const glm::dvec3& axis() const { return plane_.axis; }

 private:
  static constexpr int kBins = 96;  // angles
  void FindCrescent(const SurfaceMesh& whole);
  void FindBorder(const SurfaceMesh& whole);
  GrainPoint InCrescent(const glm::dvec3& flat) const;

  simulation::TissueStructure structure_ = simulation::TissueStructure::kPlain;
  PlaneFit plane_;
  // Crescent: radius of its circle (m), its first angle and its extent (rad), mean width (m), and
  // radii of its edges per angle (m).
  double radius_ = 0, begin_ = 0, sweep_ = 0, width_ = 0;
  std::array<double, kBins + 1> inner_{}, outer_{};
  std::vector<glm::dvec3> border_;  // border of a plate, in the plane
};

}  // namespace arthro::app

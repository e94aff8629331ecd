// Strands that stand out from the surface of a tissue: fibre bundles that a cut has frayed, and
// villi of a synovium. Each is a tube with three sides that tapers to a point. It grows on one
// triangle, chosen by a hash of the triangle's place at rest, so that it stays where it is when the
// surface changes elsewhere, and it follows that triangle. m, the tissue's own frame.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "app/view/drawing/tissue_grain.h"
#include "simulation/scene/mesh/surface_mesh.h"
#include "simulation/tissue/body/tissue_look.h"

namespace arthro::app {

// Directions are in the frame of the triangle: along its first side, in its plane, and outwards.
struct Strand {
  std::array<int, 3> corners{};              // vertices of its triangle
  glm::dvec3 root{0.0};                      // barycentric
  glm::dvec3 way{0.0, 0.0, 1.0}, bend{0.0};  // direction at the root; change of it to the tip
  double length = 0, radius = 0;             // m
  double sway = 0;                           // m, way of the tip in the flow
  double phase = 0, rate = 0;                // rad, rad/s
};

inline constexpr std::size_t kMostStrands = 3000;  // per tissue, of each kind, on average

// `fresh` is 1 for a vertex of a cut face; without one there is nothing frayed. Bundles that the
// cut meets across stand out the most.
std::vector<Strand> FrayedFibres(const SurfaceMesh& surface, std::span<const std::uint8_t> fresh,
                                 const TissueGrain& grain, const simulation::TissueLook& look);
std::vector<Strand> Villi(const SurfaceMesh& surface, const simulation::TissueLook& look);

// Tubes of strands, with unit normals; the number of vertices depends on that of the strands alone.
struct StrandMesh {
  SurfaceMesh surface;
  std::vector<glm::dvec3> normals;
};
// `positions`: of the surface that the strands grow on; `time` in s.
StrandMesh MeshOf(std::span<const Strand> strands, std::span<const glm::dvec3> positions,
                  double time);

}  // namespace arthro::app

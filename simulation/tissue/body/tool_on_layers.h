// Whole instrument on thin elastic layers: its equilibrium position and force, while a spring pulls
// it to its hand. It is translated, not rotated: its rod passes through the incision.
//
// Each capsule presses by the closed forms of elastic_layer.h along its whole length. The part that
// lies along the surface presses as a line. An end presses as a ball, with half its force when
// lying and its full force when standing. Each form alone is right (a standing rod, a long lying
// one). In between, the parts are assumed not to interact. This is within 6 % of boundary elements
// for rods of a probe and a punch at all tilts, up to 0.3 mm deep in 2.5 mm.
//
// All forces start at zero and follow the surface's distance field, so a tool that rolls or tilts
// from one part onto another feels no step. Towards the bone they rise without bound. Portal frame,
// m, N; noexcept, allocates nothing, a bounded number of steps.
#pragma once

#include <span>

#include <glm/vec3.hpp>

#include "simulation/tissue/body/elastic_layer.h"
#include "simulation/tissue/contact/tool_shape.h"
#include "simulation/tissue/field/implicit_tissue.h"

namespace arthro::simulation {

struct LayerUnder {
  // Throws Error(kBadMesh) for a surface that is not closed, which has no inside.
  LayerUnder(const SurfaceMesh& surface, const Rigid3& portal_from_surface, const ElasticLayer& of,
             int index);
  PosedField solid;
  ElasticLayer layer;
  int tissue = -1;      // in the scene
  double half_way = 0;  // m, greatest distance from the surface to its medial surface
};

struct LayerForce {
  glm::dvec3 force{0.0};      // N, on the tool
  glm::dmat3 stiffness{0.0};  // N/m, against its motion
  double depth = 0;           // m, of its deepest point
  double clear = 0;           // m that it can move without touching more
  int tissue = -1;            // tissue with the largest part; −1: no contact
  bool is_deep = false;       // beyond the range of the theory
  bool is_through = false;    // at the depth limit
};
// `tool` holds its capsules with the tip at the origin.
LayerForce ComputeLayerForce(std::span<const LayerUnder> layers, std::span<const Capsule> tool,
                             const glm::dvec3& tip) noexcept;

struct LayerHold {
  glm::dvec3 tip{0.0};    // equilibrium position
  glm::dvec3 force{0.0};  // on the tool: stiffness · (tip − held)
  double depth = 0;
  int tissue = -1;
  bool is_deep = false;
};
// Finds the equilibrium. `held`: where the spring of `stiffness` pulls the tip; `before`: its
// position one tick ago, not yet in a layer. Coulomb friction lets the tip lag behind.
LayerHold HoldOnLayers(std::span<const LayerUnder> layers, std::span<const Capsule> tool,
                       const glm::dvec3& held, const glm::dvec3& before, double stiffness,
                       double friction) noexcept;

}  // namespace arthro::simulation

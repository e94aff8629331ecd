// A whole instrument on thin elastic layers: where they let it be, and with which force, while a
// spring pulls it to its hand. It is moved along, not turned: its rod goes through the incision.
//
// Each capsule presses by the closed forms of elastic_layer.h, everywhere along it: as a line, for
// the part of its length that lies along the surface, and as a ball with its ends, half where it
// lies and whole where it stands on one. Both are right alone (a rod that stands, a long one that
// lies); between them the parts are taken not to feel each other: within 6 % of boundary elements
// for rods of a probe and a punch at all tilts, up to 0.3 mm deep in 2.5 mm. All forces begin with
// nothing and follow the surface's distance field, so a tool that rolls or tilts from one part onto
// another feels no step. Towards the bone they rise without bound. Portal frame, m, N; noexcept,
// allocates nothing, a bounded number of steps.
#pragma once

#include <span>

#include <glm/vec3.hpp>

#include "simulation/tissue/body/elastic_layer.h"
#include "simulation/tissue/contact/tool_shape.h"
#include "simulation/tissue/field/posed_field.h"

namespace arthro::simulation {

struct LayerUnder {
  // A surface that is not closed has no inside: throws Error(kBadMesh).
  LayerUnder(const SurfaceMesh& surface, const Rigid3& portal_from_surface, const ElasticLayer& of,
             int index);
  PosedField solid;
  ElasticLayer layer;
  int tissue = -1;      // in the scene
  double half_way = 0;  // m, from the surface to the middle of it where that is furthest
};

struct LayerForce {
  glm::dvec3 force{0.0};      // N, on the tool
  glm::dmat3 stiffness{0.0};  // N/m, against its motion
  double depth = 0;           // m, of its deepest point
  double clear = 0;           // m that it can go without touching more
  int tissue = -1;            // of the largest part; −1: none touches
  bool is_deep = false;       // deeper than the theory holds
  bool is_through = false;    // as deep as it can be
};
// `tool`: its capsules with the tip at the origin.
LayerForce ForceOfLayers(std::span<const LayerUnder> layers, std::span<const Capsule> tool,
                         const glm::dvec3& tip) noexcept;

struct LayerHold {
  glm::dvec3 tip{0.0};    // where they let it be
  glm::dvec3 force{0.0};  // on the tool: stiffness · (tip − held)
  double depth = 0;
  int tissue = -1;
  bool is_deep = false;
};
// `held`: where the spring of `stiffness` pulls the tip; `before`: where it was a tick ago, not yet
// in a layer. Coulomb's friction lets it lag behind.
LayerHold HoldOnLayers(std::span<const LayerUnder> layers, std::span<const Capsule> tool,
                       const glm::dvec3& held, const glm::dvec3& before, double stiffness,
                       double friction) noexcept;

}  // namespace arthro::simulation

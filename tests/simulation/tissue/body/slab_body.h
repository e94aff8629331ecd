// Slab of 648 T10, 20 × 20 × 6 mm, its top at z = 0, fixed at its underside, as a simulated tissue.
#pragma once

#include <numbers>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "simulation/tissue/body/deformable_body.h"
#include "tests/simulation/tissue/contact/slab.h"
#include "tests/simulation/tissue/cut/mesh_boundary.h"
#include "tests/support/ticks.h"

namespace arthro::test {

inline simulation::BodySpec SlabBody() {
  simulation::BodySpec spec;
  spec.name = "slab";
  spec.mesh = SlabMesh(2);
  spec.surface = BoundaryOf(SlabMesh(1, {40, 40, 12}));
  spec.material.young_modulus = 5e5;
  // Balls along the underside contain all of its nodes and no others.
  for (double x = -0.01; x <= 0.0101; x += 0.5e-3)
    for (double y = -0.01; y <= 0.0101; y += 0.5e-3)
      spec.fixed.push_back({{x, y, kSlabLow.z}, 0.9e-3});
  spec.portal_from_body = {glm::angleAxis(0.7, glm::normalize(glm::dvec3(1, 2, 3))),
                           {0.01, 0.02, 0.03}};
  return spec;
}

// Tool that points straight down onto the top, its tip `depth` below the top at rest.
inline simulation::WorldTool ToolAbove(const simulation::BodySpec& spec, simulation::ToolKind kind,
                                       double depth, double x = 0.0) {
  simulation::WorldTool tool;
  tool.shape = simulation::ShapeOf(kind);
  tool.now.is_present = true;
  // Tool z (along the rod) is the slab's −z.
  const Rigid3 body_from_tool{glm::angleAxis(std::numbers::pi, glm::dvec3(1, 0, 0)),
                              {x, 0.0, -depth}};
  tool.now.portal_from_tool = spec.portal_from_body * body_from_tool;
  return tool;
}

}  // namespace arthro::test

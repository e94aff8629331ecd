// Meniscus crescent of 504 T10 in three layers as a simulated tissue: 10 to 20 mm from its axis,
// 1.5 mm high inside and 6 mm outside, both horns fixed [benchmarks.md, Tissue references]. Its
// skin is finer than its elements. Own frame, m.
#pragma once

#include <algorithm>
#include <cmath>

#include <glm/gtc/quaternion.hpp>

#include "simulation/core/units.h"
#include "simulation/tissue/body/deformable_body.h"
#include "tests/simulation/tissue/cut/mesh_boundary.h"
#include "tests/support/tissue/tissue_meshes.h"

namespace arthro::test {

// `along`, `across`, `high`: cells of the crescent, six elements each.
inline simulation::BodySpec MeniscusBody(const Cells& cells = {14, 3, 2}) {
  simulation::BodySpec spec;
  spec.name = "meniscus";
  spec.mesh = MeniscusMesh(2, MeniscusTicks(cells));
  spec.surface =
      BoundaryOf(MeniscusMesh(1, MeniscusTicks({4 * cells[0], 4 * cells[1], 4 * cells[2]})));
  spec.material.young_modulus = 5e5;
  for (const double side : {-1.0, 1.0}) {
    const double angle = side * RadiansFromDegrees(0.5 * kSweepDegrees);
    for (const double radius : {0.0115, 0.015, 0.0185})
      spec.fixed.push_back({{radius * std::cos(angle), radius * std::sin(angle), 0.0025}, 0.0035});
  }
  spec.portal_from_body = {glm::angleAxis(-0.4, glm::normalize(glm::dvec3(2, -1, 1))),
                           {0.005, -0.01, 0.045}};
  spec.is_cuttable = true;
  return spec;
}

}  // namespace arthro::test

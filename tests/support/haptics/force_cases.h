// Error of the force on a tip against a closed form, on strokes under exactly known surfaces: the
// paper's kernel, the proxy over a depth map, the proxy over triangles. Friction and viscosity are
// off, since the reference has none. Targets: [benchmarks.md, Haptics]. Portal frame, m, N.
#pragma once

#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "simulation/haptics/contact.h"
#include "tests/support/haptics/analytic_relief.h"

namespace arthro::test {

// One point per tick: place of the tip, and the exact force there.
struct TouchStroke {
  std::vector<glm::dvec3> tip, reference;
  std::vector<glm::dvec2> pixel;  // pixel of the surface point that is nearest to the tip
};
inline constexpr double kTouchStiffness = 500;  // N/m
inline constexpr double kTouchTick = 1e-3;      // s
// A stroke of 4 s over half of the picture's width, 1 mm ± 0.3 mm under the exact surface, at 10 to
// 25 mm/s in a picture 1024 px wide.
TouchStroke StrokeUnder(const AnalyticRelief& relief);

// The contact of a bare spring.
simulation::ContactOptions BareContact();

// The force of each tick.
std::vector<glm::dvec3> ProxyForces(const simulation::Surroundings& around,
                                    const TouchStroke& stroke);
std::vector<glm::dvec3> PaperForces(const Backdrop& backdrop, const DepthMap& map,
                                    const TouchStroke& stroke);

struct ForceErrors {
  double rms = 0;                       // relative to the reference's rms
  double angle_p99 = 0, angle_max = 0;  // rad
  double excess_step = 0;               // N, largest change per tick beyond the reference's
};
// Leaves out the first 0.1 s, in which the tip comes from its portal.
ForceErrors ErrorsOf(const std::vector<glm::dvec3>& force,
                     const std::vector<glm::dvec3>& reference);

}  // namespace arthro::test

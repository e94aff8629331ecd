// How far the force on a tip is from a closed form: strokes under surfaces that are known exactly,
// felt by the paper's kernel, by our proxy over a depth map, and by it over triangles. Friction and
// viscosity are off: they are not part of the reference. Targets: [benchmarks.md, Haptics].
// Portal frame, m, N.
#pragma once

#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "simulation/haptics/contact.h"
#include "tests/support/haptics/analytic_relief.h"

namespace arthro::test {

// One point a tick: where the tip is, and the exact force there.
struct TouchStroke {
  std::vector<glm::dvec3> tip, reference;
  std::vector<glm::dvec2> pixel;  // of the point of the surface that is nearest to the tip
};
inline constexpr double kTouchStiffness = 500;  // N/m
inline constexpr double kTouchTick = 1e-3;      // s
// 4 s of a wandering stroke over half of the picture's width, 10 to 25 mm/s where it is 1024 px
// wide, 1 mm ± 0.3 mm under the exact surface.
TouchStroke StrokeUnder(const AnalyticRelief& relief);

// The contact of a bare spring.
simulation::ContactOptions BareContact();

// The force of each tick.
std::vector<glm::dvec3> ProxyForces(const simulation::Surroundings& around,
                                    const TouchStroke& stroke);
std::vector<glm::dvec3> PaperForces(const Backdrop& backdrop, const DepthMap& map,
                                    const TouchStroke& stroke);

struct ForceErrors {
  double rms = 0;                       // share of the reference's rms
  double angle_p99 = 0, angle_max = 0;  // rad
  double excess_step = 0;               // N, largest change in a tick beyond the reference's
};
// The first tenth of a second is left out: the tip comes from its portal there.
ForceErrors ErrorsOf(const std::vector<glm::dvec3>& force,
                     const std::vector<glm::dvec3>& reference);

}  // namespace arthro::test

#include "authoring/phantom/shape/crescent.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/gtc/quaternion.hpp>

#include "authoring/phantom/shape/noise.h"
#include "simulation/core/units.h"

namespace arthro::authoring {
Crescent MakeCrescent(const Cavity& cavity) {
  Random random(0x3E415C05ull + cavity.seed);
  Crescent c;
  // Near(mean, share): a mean in mm and its relative spread. The sizes are chosen, not measured.
  c.centre = glm::dvec2(random.Uniform(-0.3, 0.6), random.Uniform(-0.2, 0.4)) * kMm;
  c.outer_x = random.Near(16.4, 0.015) * kMm;
  c.outer_y = random.Near(15.6, 0.015) * kMm;
  c.from = RadiansFromDegrees(random.Uniform(-92.0, -84.0));
  c.to = RadiansFromDegrees(random.Uniform(132.0, 140.0));
  c.body_width = random.Near(8.4, 0.04) * kMm;
  c.posterior_width = random.Near(9.6, 0.03) * kMm;
  c.anterior_width = random.Near(7.0, 0.04) * kMm;
  c.body_height = random.Near(5.7, 0.04) * kMm;
  c.posterior_height = random.Near(5.2, 0.04) * kMm;
  c.anterior_height = random.Near(4.3, 0.04) * kMm;
  c.plateau_from_tissue.rotation =
      glm::angleAxis(RadiansFromDegrees(random.Uniform(-20.0, 20.0)), glm::dvec3(0, 0, 1));
  c.plateau_from_tissue.translation = {c.centre.x, c.centre.y,
                                       BoneHeight(cavity.plateau, c.centre.x, c.centre.y)};
  return c;
}

Wedge WedgeAt(const Crescent& c, double angle) {
  const double posterior = SmoothStep(0.2, 1.4, angle), anterior = SmoothStep(-0.1, -1.1, angle);
  Wedge wedge{c.body_width + posterior * (c.posterior_width - c.body_width) +
                  anterior * (c.anterior_width - c.body_width),
              c.body_height + posterior * (c.posterior_height - c.body_height) +
                  anterior * (c.anterior_height - c.body_height)};
  // Equals 1 at 29° from a horn's end. A steeper taper would shear the rings, whose number of
  // points is fixed, into slivers.
  constexpr double kTaper = 0.50;                        // rad from a horn's end
  constexpr double kEndWidth = 0.36, kEndHeight = 0.38;  // shares of the body's at the end
  const double from_end = std::clamp(std::min(angle - c.from, c.to - angle) / kTaper, 0.0, 1.0);
  const double full = std::sin(0.5 * std::numbers::pi * from_end);
  wedge.width *= kEndWidth + 0.64 * full;
  wedge.height *= kEndHeight + 0.62 * full;
  return wedge;
}

glm::dvec3 OnPlateau(const Cavity& cavity, const Crescent& c, double angle, double r, double lift) {
  const double x = c.centre.x + r * std::cos(angle), y = c.centre.y + r * std::sin(angle);
  return {x, y, BoneHeight(cavity.plateau, x, y) + lift};
}

double OuterRadius(const Crescent& c, double angle) {
  const double u = std::cos(angle) / c.outer_x, v = std::sin(angle) / c.outer_y;
  return 1.0 / std::sqrt(u * u + v * v);
}

double EdgeThickness(const Crescent& c, const Wedge& wedge) {
  return std::min(c.edge, 0.3 * wedge.height);
}

double TopOf(const Crescent& c, const Wedge& wedge, double q) {
  const double edge = EdgeThickness(c, wedge);
  return c.film + edge +
         (wedge.height - edge) * std::pow(q, 1.35) * (1.0 - 0.07 * SmoothStep(0.8, 1.0, q));
}

double RimBulge(const Wedge& wedge, double up) {
  return 0.16 * wedge.height * std::sin(std::numbers::pi * up);
}

}  // namespace arthro::authoring

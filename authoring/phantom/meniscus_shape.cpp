#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>

#include "authoring/phantom/noise.h"
#include "authoring/phantom/phantom_tissue.h"
#include "simulation/core/units.h"

namespace arthro::authoring {
namespace {

constexpr double kMm = kMetrePerMillimetre;

// Sizes of the crescent in the plateau's frame; angles from medial (0) to posterior (90°).
struct Crescent {
  glm::dvec2 centre{0.0};
  double outer_x = 0, outer_y = 0;  // radii of the outer rim
  double from = 0, to = 0;          // anterior and posterior horn
  double body_width = 0, posterior_width = 0, anterior_width = 0;
  double body_height = 0, posterior_height = 0, anterior_height = 0;
  double edge = 0.42 * kMm;  // thickness of the free edge
  double film = 0.10 * kMm;  // of fluid between meniscus and plateau
};

Crescent MakeCrescent(Random& random) {
  Crescent c;
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
  return c;
}

// Width and height of the wedge at an angle; both taper towards the horns.
struct Wedge {
  double width, height;
};
Wedge WedgeAt(const Crescent& c, double angle) {
  const double posterior = SmoothStep(0.2, 1.4, angle), anterior = SmoothStep(-0.1, -1.1, angle);
  Wedge wedge{c.body_width + posterior * (c.posterior_width - c.body_width) +
                  anterior * (c.anterior_width - c.body_width),
              c.body_height + posterior * (c.posterior_height - c.body_height) +
                  anterior * (c.anterior_height - c.body_height)};
  // 1 at 29° from a horn's end. The taper is never so steep that rings, which keep their number of
  // points, would shear into slivers.
  const double from_end = std::clamp(std::min(angle - c.from, c.to - angle) / 0.50, 0.0, 1.0);
  const double full = std::sin(0.5 * std::numbers::pi * from_end);
  wedge.width *= 0.36 + 0.64 * full;
  wedge.height *= 0.38 + 0.62 * full;
  return wedge;
}

// One closed profile: bottom from the free edge outwards, up the rim, back over the top, round the
// edge.
constexpr int kFlat = 9, kRim = 4;  // spans along bottom or top, and points between them on the rim
constexpr int kProfile = 2 * (kFlat + 1) + kRim + 1;

glm::dvec3 OnPlateau(const Cavity& cavity, const Crescent& c, double angle, double r, double lift) {
  const double x = c.centre.x + r * std::cos(angle), y = c.centre.y + r * std::sin(angle);
  return {x, y, PlateauHeight(cavity.plateau, x, y) + lift};
}

double OuterRadius(const Crescent& c, double angle) {
  const double u = std::cos(angle) / c.outer_x, v = std::sin(angle) / c.outer_y;
  return 1.0 / std::sqrt(u * u + v * v);
}

struct ProfilePoint {
  glm::dvec3 x;
  double rim;
};
ProfilePoint ProfileAt(const Cavity& cavity, const Crescent& c, double angle, int index) {
  const Wedge wedge = WedgeAt(c, angle);
  const double outer = OuterRadius(c, angle), inner = outer - wedge.width;
  const double edge = std::min(c.edge, 0.3 * wedge.height);
  // A wedge with a slightly hollow back, that turns over at its outer shoulder.
  const auto top = [&](double q) {
    return c.film + edge +
           (wedge.height - edge) * std::pow(q, 1.35) * (1.0 - 0.07 * SmoothStep(0.8, 1.0, q));
  };
  if (index <= kFlat) {
    const double q = static_cast<double>(index) / kFlat;
    return {OnPlateau(cavity, c, angle, inner + q * wedge.width, c.film), q};
  }
  if (index <= kFlat + kRim) {
    const double up = static_cast<double>(index - kFlat) / (kRim + 1);
    const double bulge = 0.16 * wedge.height * std::sin(std::numbers::pi * up);
    return {OnPlateau(cavity, c, angle, outer + bulge, c.film + up * (top(1.0) - c.film)), 1.0};
  }
  if (index <= 2 * kFlat + kRim + 1) {
    const double q = static_cast<double>(2 * kFlat + kRim + 1 - index) / kFlat;
    return {OnPlateau(cavity, c, angle, inner + q * wedge.width, top(q)), q};
  }
  return {OnPlateau(cavity, c, angle, inner - 0.45 * edge, c.film + 0.5 * edge), 0.0};
}

}  // namespace

PhantomTissue MakeMeniscus(const Cavity& cavity) {
  Random random(0x3E415C05ull + cavity.seed);
  const Crescent c = MakeCrescent(random);
  const Rigid3& portal_from_plateau = cavity.plateau.portal_from_plateau;
  Rigid3 plateau_from_tissue;
  plateau_from_tissue.rotation =
      glm::angleAxis(RadiansFromDegrees(random.Uniform(-20.0, 20.0)), glm::dvec3(0, 0, 1));
  plateau_from_tissue.translation = {c.centre.x, c.centre.y,
                                     PlateauHeight(cavity.plateau, c.centre.x, c.centre.y)};
  const Rigid3 tissue_from_plateau = Inverse(plateau_from_tissue);
  const Rigid3 portal_from_tissue = portal_from_plateau * plateau_from_tissue;

  PhantomTissue tissue;
  tissue.name = "medial meniscus";
  tissue.portal_from_tissue = {portal_from_tissue.translation, portal_from_tissue.rotation, 1.0};
  // Rings from the anterior to the posterior horn, about as far apart as the points of a ring.
  constexpr int kRings = 76;
  constexpr double kBevel = 0.5 * kMm;
  for (int ring = 0; ring < kRings; ++ring) {
    // The first and the last are the bevels of the horns' ends: their neighbours, shrunk and pushed
    // on.
    const int drawn = std::clamp(ring, 1, kRings - 2);
    const double angle = c.from + (c.to - c.from) * (drawn - 1) / (kRings - 3);
    std::array<ProfilePoint, kProfile> profile;
    glm::dvec3 middle(0.0);
    for (int i = 0; i < kProfile; ++i) {
      profile[i] = ProfileAt(cavity, c, angle, i);
      middle += profile[i].x / static_cast<double>(kProfile);
    }
    const double on = ring < drawn ? -kBevel : ring > drawn ? kBevel : 0.0;
    const glm::dvec3 along(-std::sin(angle), std::cos(angle), 0.0);
    for (const ProfilePoint& point : profile) {
      const glm::dvec3 x = on == 0.0 ? point.x : middle + 0.6 * (point.x - middle) + on * along;
      tissue.surface.vertices.push_back(tissue_from_plateau * x);
      tissue.rims.push_back(point.rim);
    }
  }
  auto& triangles = tissue.surface.triangles;
  const auto vertex = [](int ring, int i) { return ring * kProfile + i % kProfile; };
  for (int ring = 0; ring + 1 < kRings; ++ring)
    for (int i = 0; i < kProfile; ++i) {
      const int a = vertex(ring, i), b = vertex(ring, i + 1), d = vertex(ring + 1, i),
                e = vertex(ring + 1, i + 1);
      // Diagonals alternate, so that no direction is stiffer.
      if ((ring + i) % 2) {
        triangles.push_back({a, e, b});
        triangles.push_back({a, d, e});
      } else {
        triangles.push_back({a, d, b});
        triangles.push_back({b, d, e});
      }
    }
  // The horns' ends: bottom and top of the profile zipped together.
  for (const int ring : {0, kRings - 1}) {
    const auto face = [&](int i, int j, int k) {
      if (ring != 0)
        triangles.push_back({vertex(ring, i), vertex(ring, k), vertex(ring, j)});
      else
        triangles.push_back({vertex(ring, i), vertex(ring, j), vertex(ring, k)});
    };
    const auto top = [](int i) { return 2 * kFlat + kRim + 1 - i; };
    for (int i = 0; i + 1 < kFlat; ++i) {
      face(i, i + 1, top(i + 1));
      face(i, top(i + 1), top(i));
    }
    // The rim's lower half hangs on the last but one point of the bottom, its upper half on that of
    // the top.
    constexpr int kLow = kFlat - 1, kMiddle = kFlat + (kRim + 1) / 2;
    for (int i = kFlat; i < kMiddle; ++i) face(kLow, i, i + 1);
    face(kLow, kMiddle, top(kLow));
    for (int i = kMiddle; i < top(kFlat); ++i) face(top(kLow), i, i + 1);
    face(0, top(0), kProfile - 1);
  }

  const auto landmark = [&](const char* name, double angle, int index) {
    tissue.landmarks.push_back({name, portal_from_plateau * ProfileAt(cavity, c, angle, index).x});
  };
  constexpr int kEdge = kProfile - 1, kShoulder = kFlat + kRim + 1;
  landmark("meniscus anterior horn", c.from, kShoulder);
  landmark("meniscus posterior horn", c.to, kShoulder);
  landmark("meniscus body, free edge", 0.0, kEdge);
  landmark("meniscus body, outer rim", 0.0, kShoulder);
  landmark("meniscus posterior, free edge", 0.5 * std::numbers::pi, kEdge);
  landmark("meniscus posterior, outer rim", 0.5 * std::numbers::pi, kShoulder);
  return tissue;
}

}  // namespace arthro::authoring

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>

#include "authoring/phantom/crescent.h"
#include "authoring/phantom/noise.h"
#include "authoring/phantom/phantom_tissue.h"
#include "simulation/core/units.h"

namespace arthro::authoring {
namespace {

constexpr double kMm = kMetrePerMillimetre;

// One closed profile: bottom from the free edge outwards, up the rim, back over the top, round the
// edge.
constexpr int kFlat = 9, kRim = 4;  // spans along bottom or top, and points between them on the rim
constexpr int kProfile = 2 * (kFlat + 1) + kRim + 1;

struct ProfilePoint {
  glm::dvec3 x;
  double rim;
};
ProfilePoint ProfileAt(const Cavity& cavity, const Crescent& c, double angle, int index) {
  const Wedge wedge = WedgeAt(c, angle);
  const double outer = OuterRadius(c, angle), inner = outer - wedge.width;
  const double edge = EdgeThickness(c, wedge);
  const auto top = [&](double q) { return TopOf(c, wedge, q); };
  if (index <= kFlat) {
    const double q = static_cast<double>(index) / kFlat;
    return {OnPlateau(cavity, c, angle, inner + q * wedge.width, c.film), q};
  }
  if (index <= kFlat + kRim) {
    const double up = static_cast<double>(index - kFlat) / (kRim + 1);
    const double bulge = RimBulge(wedge, up);
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
  const Crescent c = MakeCrescent(cavity);
  const Rigid3& portal_from_plateau = cavity.plateau.portal_from_plateau;
  const Rigid3& plateau_from_tissue = c.plateau_from_tissue;
  const Rigid3 tissue_from_plateau = Inverse(plateau_from_tissue);
  const Rigid3 portal_from_tissue = portal_from_plateau * plateau_from_tissue;

  PhantomTissue tissue;
  tissue.name = "medial meniscus";
  tissue.portal_from_tissue = {portal_from_tissue.translation, portal_from_tissue.rotation, 1.0};
  FillMeniscus(cavity, c, tissue);
  // Rings from the anterior to the posterior horn, spaced about as the points of a ring.
  constexpr int kRings = 76;
  constexpr double kBevel = 0.5 * kMm;
  for (int ring = 0; ring < kRings; ++ring) {
    // The first and the last ring are the bevels of the horns' ends: their neighbours, shrunk and
    // displaced.
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
  // Triangles of the horns' ends, between bottom and top of the profile.
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
    // Triangles of the rim's lower half share the second last point of the bottom, those of its
    // upper half the second last of the top.
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

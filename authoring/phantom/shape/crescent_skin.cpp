#include "authoring/phantom/shape/crescent_skin.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "simulation/core/units.h"

namespace arthro::authoring {
namespace {

// One closed profile: bottom from the free edge outwards, up the rim, back over the top, round the
// edge.
constexpr int kFlat = 9,
              kRimPoints = 4;  // spans along bottom or top, and points between them on the rim
constexpr int kProfile = 2 * (kFlat + 1) + kRimPoints + 1;
constexpr int kEdge = kProfile - 1, kShoulder = kFlat + kRimPoints + 1;

struct ProfilePoint {
  glm::dvec3 x;
  double rim;
};
ProfilePoint ProfileAt(const Crescent& c, const CrescentGround& ground, double angle, int index) {
  const Wedge wedge = WedgeAt(c, angle);
  const double outer = OuterRadius(c, angle), inner = outer - wedge.width;
  const double edge = EdgeThickness(c, wedge);
  const auto top = [&](double q) { return TopOf(c, wedge, q); };
  if (index <= kFlat) {
    const double q = static_cast<double>(index) / kFlat;
    return {ground(angle, inner + q * wedge.width, c.film), q};
  }
  if (index <= kFlat + kRimPoints) {
    const double up = static_cast<double>(index - kFlat) / (kRimPoints + 1);
    const double bulge = RimBulge(wedge, up);
    return {ground(angle, outer + bulge, c.film + up * (top(1.0) - c.film)), 1.0};
  }
  if (index <= 2 * kFlat + kRimPoints + 1) {
    const double q = static_cast<double>(2 * kFlat + kRimPoints + 1 - index) / kFlat;
    return {ground(angle, inner + q * wedge.width, top(q)), q};
  }
  return {ground(angle, inner - 0.45 * edge, c.film + 0.5 * edge), 0.0};
}

}  // namespace

CrescentSkin SkinOf(const Crescent& c, const CrescentGround& ground) {
  CrescentSkin skin;
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
      profile[i] = ProfileAt(c, ground, angle, i);
      middle += profile[i].x / static_cast<double>(kProfile);
    }
    const double on = ring < drawn ? -kBevel : ring > drawn ? kBevel : 0.0;
    const glm::dvec3 along(-std::sin(angle), std::cos(angle), 0.0);
    for (const ProfilePoint& point : profile) {
      const glm::dvec3 x = on == 0.0 ? point.x : middle + 0.6 * (point.x - middle) + on * along;
      skin.surface.vertices.push_back(x);
      skin.rims.push_back(point.rim);
    }
  }
  auto& triangles = skin.surface.triangles;
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
    const auto top = [](int i) { return 2 * kFlat + kRimPoints + 1 - i; };
    for (int i = 0; i + 1 < kFlat; ++i) {
      face(i, i + 1, top(i + 1));
      face(i, top(i + 1), top(i));
    }
    // Triangles of the rim's lower half share the second last point of the bottom, those of its
    // upper half the second last of the top.
    constexpr int kLow = kFlat - 1, kMiddle = kFlat + (kRimPoints + 1) / 2;
    for (int i = kFlat; i < kMiddle; ++i) face(kLow, i, i + 1);
    face(kLow, kMiddle, top(kLow));
    for (int i = kMiddle; i < top(kFlat); ++i) face(top(kLow), i, i + 1);
    face(0, top(0), kProfile - 1);
  }
  return skin;
}

glm::dvec3 FreeEdgeAt(const Crescent& c, const CrescentGround& ground, double angle) {
  return ProfileAt(c, ground, angle, kEdge).x;
}

glm::dvec3 ShoulderAt(const Crescent& c, const CrescentGround& ground, double angle) {
  return ProfileAt(c, ground, angle, kShoulder).x;
}

}  // namespace arthro::authoring

// Rays meet the cavity's surfaces at points that satisfy the surfaces' formulas, and the cavity
// leaves room for the tools.
#include "authoring/phantom/cavity.h"

#include <cmath>
#include <cstdio>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "authoring/phantom/noise.h"

namespace arthro::authoring {
namespace {

constexpr int kSeeds[] = {0, 1, 2, 3, 17, 2147483647};

glm::dvec3 DirectionOf(double longitude_deg, double latitude_deg) {
  const double lon = longitude_deg * M_PI / 180.0, lat = latitude_deg * M_PI / 180.0;
  return {std::cos(lat) * std::sin(lon), -std::sin(lat), std::cos(lat) * std::cos(lon)};
}

template <class Check>
void ForEachRay(const Check& check) {
  for (double lat = -74; lat <= 74; lat += 2)
    for (double lon = -99; lon <= 99; lon += 2) check(DirectionOf(lon, lat));
}

TEST(Cavity, HitsSatisfyTheFormulaOfTheirSurface) {
  for (const int seed : kSeeds) {
    const Cavity cavity = MakeCavity(static_cast<std::uint32_t>(seed));
    double worst_condyle = 0, worst_plateau = 0, worst_ligament = 0;
    int condyle = 0, plateau = 0, ligament = 0;
    ForEachRay([&](const glm::dvec3& d) {
      const CavityHit hit = CastFromPortal(cavity, d);
      const glm::dvec3 x = hit.distance * d;
      if (hit.surface == Surface::kCondyle) {
        // (p·p)/r² = 1 in the ellipsoid's own axes; the residual is converted to a length.
        const glm::dvec3 p =
            glm::conjugate(cavity.condyle.portal_from_body) * (x - cavity.condyle.centre);
        const double f = glm::dot(p / cavity.condyle.radii, p / cavity.condyle.radii) - 1.0;
        worst_condyle = std::max(worst_condyle, 0.5 * std::abs(f) * cavity.condyle.radii.y);
        ++condyle;
      } else if (hit.surface == Surface::kPlateau) {
        const glm::dvec3 p = Inverse(cavity.plateau.portal_from_plateau) * x;
        worst_plateau =
            std::max(worst_plateau, std::abs(p.z - PlateauHeight(cavity.plateau, p.x, p.y)));
        ++plateau;
      } else if (hit.surface == Surface::kLigament) {
        double nearest = 1.0;
        for (const Bundle& bundle : cavity.ligament) {
          const glm::dvec3 axis = bundle.to - bundle.from;
          const double t =
              std::clamp(glm::dot(x - bundle.from, axis) / glm::dot(axis, axis), 0.0, 1.0);
          nearest =
              std::min(nearest, std::abs(glm::distance(x, bundle.from + t * axis) - bundle.radius));
        }
        worst_ligament = std::max(worst_ligament, nearest);
        ++ligament;
      }
    });
    std::printf(
        "seed %d: residual condyle %.1e m (%d rays), plateau %.1e m (%d), ligament %.1e m (%d)\n",
        seed, worst_condyle, condyle, worst_plateau, plateau, worst_ligament, ligament);
    EXPECT_GT(condyle, 300);
    EXPECT_GT(plateau, 300);
    EXPECT_GT(ligament, 10);
    EXPECT_LT(worst_condyle, 1e-9);
    EXPECT_LT(worst_plateau, 1e-9);
    EXPECT_LT(worst_ligament, 1e-9);
  }
}

// A slow ray cast that shares only the formulas with the fast one: steps of 10 µm until inside any
// surface.
TEST(Cavity, NothingLiesInFrontOfAHit) {
  const Cavity cavity = MakeCavity(1);
  const auto inside = [&](const glm::dvec3& x) {
    const glm::dvec3 p = Inverse(cavity.plateau.portal_from_plateau) * x;
    if (p.z < PlateauHeight(cavity.plateau, p.x, p.y)) return true;
    const glm::dvec3 e =
        (glm::conjugate(cavity.condyle.portal_from_body) * (x - cavity.condyle.centre)) /
        cavity.condyle.radii;
    if (glm::dot(e, e) < 1.0) return true;
    for (const Bundle& bundle : cavity.ligament) {
      const glm::dvec3 axis = bundle.to - bundle.from;
      const double t = std::clamp(glm::dot(x - bundle.from, axis) / glm::dot(axis, axis), 0.0, 1.0);
      if (glm::distance(x, bundle.from + t * axis) < bundle.radius) return true;
    }
    return false;
  };
  constexpr double kStep = 1e-5;
  double worst = 0.0;
  Random random(5);
  for (int i = 0; i < 500; ++i) {
    const glm::dvec3 d = DirectionOf(random.Uniform(-99, 99), random.Uniform(-74, 74));
    const double wall = std::min(CapsuleDistance(cavity, d), FatDistance(cavity, d));
    double s = 0.0;
    while (s < wall && !inside(s * d)) s += kStep;
    worst = std::max(worst, std::abs(std::min(s, wall) - CastFromPortal(cavity, d).distance));
  }
  std::printf("largest difference from the slow cast: %.1e m\n", worst);
  EXPECT_LE(worst, kStep);
}

TEST(Cavity, LiesBetween12And48MillimetresFromThePortal) {
  for (int seed = 0; seed < 40; ++seed) {
    const Cavity cavity = MakeCavity(static_cast<std::uint32_t>(seed));
    double nearest = 1, furthest = 0;
    ForEachRay([&](const glm::dvec3& d) {
      const double distance = CastFromPortal(cavity, d).distance;
      nearest = std::min(nearest, distance), furthest = std::max(furthest, distance);
    });
    EXPECT_GE(nearest, 0.012) << "seed " << seed;
    EXPECT_LE(furthest, 0.048) << "seed " << seed;
  }
}

TEST(Cavity, LeavesRoomForScopeAndInstrument) {
  for (int seed = 0; seed < 40; ++seed) {
    const Cavity cavity = MakeCavity(static_cast<std::uint32_t>(seed));
    // A straight scope, and the instrument's portal.
    EXPECT_GT(CastFromPortal(cavity, {0, 0, 1}).distance, 0.026) << "seed " << seed;
    EXPECT_GT(CastFromPortal(cavity, {1, 0, 0}).distance, 0.034) << "seed " << seed;
  }
}

TEST(Cavity, NormalsPointOutOfTheTissueTowardsTheScope) {
  const Cavity cavity = MakeCavity(3);
  ForEachRay([&](const glm::dvec3& d) {
    const CavityHit hit = CastFromPortal(cavity, d);
    const glm::dvec3 n = NormalAt(cavity, hit.surface, hit.distance * d);
    EXPECT_NEAR(glm::length(n), 1.0, 1e-12);
    EXPECT_LT(glm::dot(n, d), 0.02);  // at a silhouette the normal is perpendicular to the ray, up
                                      // to the step of the slopes
  });
}

}  // namespace
}  // namespace arthro::authoring

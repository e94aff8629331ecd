// Rays meet the cavity's surfaces at points that satisfy the surfaces' formulas, and the cavity
// leaves room for the tools.
#include "authoring/phantom/shape/cavity.h"

#include <cmath>
#include <cstdio>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "authoring/phantom/shape/crescent.h"
#include "authoring/phantom/shape/noise.h"

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
        worst_condyle = std::max(worst_condyle, std::abs(FemurClearance(cavity, x)));
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
    if (FemurClearance(cavity, x) < 0.0) return true;
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

// A fillet joins the ellipsoids: away from the others each is exact.
TEST(Cavity, TheMedialCondyleIsItsEllipsoidAwayFromTheNotch) {
  const Cavity cavity = MakeCavity(1);
  int rays = 0;
  ForEachRay([&](const glm::dvec3& d) {
    const CavityHit hit = CastFromPortal(cavity, d);
    const glm::dvec3 x = hit.distance * d;
    if (hit.surface != Surface::kCondyle || x.x < cavity.condyle.centre.x ||
        x.y < cavity.condyle.centre.y)
      return;
    // (p·p)/r² = 1 in the ellipsoid's own axes; the residual is converted to a length.
    const glm::dvec3 p =
        glm::conjugate(cavity.condyle.portal_from_body) * (x - cavity.condyle.centre);
    const double f = glm::dot(p / cavity.condyle.radii, p / cavity.condyle.radii) - 1.0;
    EXPECT_LT(0.5 * std::abs(f) * cavity.condyle.radii.y, 1e-9);
    ++rays;
  });
  EXPECT_GT(rays, 100);
}

// Every cruciate bundle ends in bone at both ends, and both horns of the
// meniscus end in a root.
TEST(Cavity, LigamentsAndHornsEndInBone) {
  for (const int seed : kSeeds) {
    const Cavity cavity = MakeCavity(static_cast<std::uint32_t>(seed));
    const auto into_plateau = [&](const glm::dvec3& x) {
      const glm::dvec3 p = Inverse(cavity.plateau.portal_from_plateau) * x;
      return BoneHeight(cavity.plateau, p.x, p.y) - p.z;
    };
    for (std::size_t i = 0; i < kAnteriorBundles + kPosteriorBundles; ++i) {
      const bool is_anterior = i < kAnteriorBundles;
      const Bundle& bundle = cavity.ligament[i];
      const glm::dvec3 tibial = is_anterior ? bundle.from : bundle.to,
                       femoral = is_anterior ? bundle.to : bundle.from;
      EXPECT_GT(into_plateau(tibial), 0.0) << "seed " << seed << ", bundle " << i;
      EXPECT_LT(EllipsoidClearance(is_anterior ? cavity.lateral_condyle : cavity.condyle, femoral),
                0.0)
          << "seed " << seed << ", bundle " << i;
    }
    const Crescent crescent = MakeCrescent(cavity);
    for (const double end : {crescent.from, crescent.to}) {
      // A point of the upper face on the last millimetre of the horn.
      const Wedge wedge = WedgeAt(crescent, end);
      const glm::dvec3 top =
          OnPlateau(cavity, crescent, end, OuterRadius(crescent, end) - 0.5 * wedge.width,
                    TopOf(crescent, wedge, 0.5));
      EXPECT_GT(PlateauHeight(cavity.plateau, top.x, top.y), top.z) << "seed " << seed;
    }
  }
}

TEST(Cavity, TheCapsuleRisesBesideTheWholeRimOfTheMeniscus) {
  for (const int seed : kSeeds) {
    const Cavity cavity = MakeCavity(static_cast<std::uint32_t>(seed));
    const Crescent crescent = MakeCrescent(cavity);
    for (double angle = 0.0; angle < 2.2; angle += 0.1) {
      constexpr double kBeyond = 5e-3;  // m
      const double r = OuterRadius(crescent, angle);
      const glm::dvec3 rim = OnPlateau(cavity, crescent, angle, r, 0.0);
      const glm::dvec2 wall =
          crescent.centre + (r + kBeyond) * glm::dvec2(std::cos(angle), std::sin(angle));
      EXPECT_GT(PlateauHeight(cavity.plateau, wall.x, wall.y),
                rim.z + WedgeAt(crescent, angle).height)
          << "seed " << seed << ", " << angle << " rad";
    }
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

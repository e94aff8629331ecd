#include "simulation/tissue/field/carved_skin.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <utility>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/core/units.h"
#include "simulation/tissue/field/pieces.h"
#include "simulation/tissue/field/polygonise.h"
#include "tests/simulation/tissue/field/closed_manifold.h"
#include "tests/support/shapes.h"

namespace arthro::simulation {
namespace {

constexpr double kSpacing = 0.35 * kMm, kRadius = 5 * kMm, kBite = 1.5 * kMm;
const glm::dvec3 kCentre = glm::dvec3(5, 0, 0) * kMm;

double FromBite(const glm::dvec3& x) { return glm::distance(x, kCentre) - kBite; }

struct Bitten {
  SurfaceMesh whole = test::Sphere({0, 0, 0}, kRadius, 5);
  SolidField field = SolidField::FromSurface(whole, kSpacing);
  SkinCarver carver{whole, field};
  double removed = field.Subtract(field.box(), FromBite).removed;
  CarvedSkin skin = carver.Carve(field);
};

TEST(CarvedSkin, KeepsTheWholeSurfaceWhereNothingWasCut) {
  const SurfaceMesh whole = test::Sphere({0, 0, 0}, kRadius, 4);
  const SolidField field = SolidField::FromSurface(whole, kSpacing);
  const CarvedSkin skin = SkinCarver(whole, field).Carve(field);
  EXPECT_EQ(skin.surface.vertices, whole.vertices);
  EXPECT_EQ(skin.surface.triangles, whole.triangles);
  EXPECT_EQ(std::ranges::count(skin.is_fresh, 1), 0);
}

TEST(CarvedSkin, KeepsTrianglesAwayFromABite) {
  const Bitten bitten;
  const auto far = [](const SurfaceMesh& surface) {
    std::vector<std::array<glm::dvec3, 3>> triangles;
    for (const auto& [a, b, c] : surface.triangles) {
      const std::array<glm::dvec3, 3> x{surface.vertices[static_cast<std::size_t>(a)],
                                        surface.vertices[static_cast<std::size_t>(b)],
                                        surface.vertices[static_cast<std::size_t>(c)]};
      if (std::ranges::all_of(x, [](const glm::dvec3& p) { return FromBite(p) > 1.5 * kMm; }))
        triangles.push_back(x);
    }
    return triangles;
  };
  EXPECT_TRUE(far(bitten.skin.surface) == far(bitten.whole));
  for (std::size_t v = 0; v < bitten.skin.whole_vertex.size(); ++v)
    if (const int whole = bitten.skin.whole_vertex[v]; whole >= 0) {
      EXPECT_EQ(bitten.skin.surface.vertices[v],
                bitten.whole.vertices[static_cast<std::size_t>(whole)]);
    }
}

TEST(CarvedSkin, EnclosesWhatTheBiteLeft) {
  const Bitten bitten;
  const double left =
      test::EnclosedVolume(bitten.whole) - test::EnclosedVolume(bitten.skin.surface);
  std::printf("bite of %.3f mm3, between the skins %.3f\n", 1e9 * bitten.removed, 1e9 * left);
  // The lips leave slits of 0.1 spacings along 9 mm, at 5 mm from the origin.
  EXPECT_NEAR(left, bitten.removed, 0.1 * kSpacing * 9 * kMm * kRadius / 3.0);
  for (std::size_t v = 0; v < bitten.skin.is_fresh.size(); ++v) {
    const glm::dvec3& x = bitten.skin.surface.vertices[v];
    if (bitten.skin.is_fresh[v] != 0) {
      EXPECT_LT(std::abs(FromBite(x)), 0.1 * kSpacing);
      EXPECT_LT(glm::length(x), kRadius + 0.15 * kSpacing);
    } else {
      EXPECT_GT(FromBite(x), -0.15 * kSpacing);
      EXPECT_NEAR(glm::length(x), kRadius, 0.03 * kSpacing);
    }
  }
}

// Open edges lie at the lips only, and there the face of the cut has passed the surface.
TEST(CarvedSkin, LipsLeaveNoGap) {
  const Bitten bitten;
  std::map<std::pair<int, int>, int> uses;
  for (const auto& t : bitten.skin.surface.triangles)
    for (std::size_t i = 0; i < 3; ++i) ++uses[std::minmax(t[i], t[(i + 1) % 3])];
  int lips = 0;
  for (const auto& [edge, count] : uses) {
    if (count == 2) continue;
    ASSERT_EQ(count, 1);
    ++lips;
    for (const int v : {edge.first, edge.second}) {
      const glm::dvec3& x = bitten.skin.surface.vertices[static_cast<std::size_t>(v)];
      if (bitten.skin.is_fresh[static_cast<std::size_t>(v)] != 0) {
        EXPECT_GT(glm::length(x), kRadius + 0.02 * kSpacing);
      } else {
        EXPECT_LT(FromBite(x), 0.02 * kSpacing);
      }
    }
  }
  EXPECT_GT(lips, 40);
}

TEST(CarvedSkin, DebrisLeavesNoSkin) {
  // A slot of 1 mm cuts the end off a bar.
  const SurfaceMesh bar =
      test::Box(glm::dvec3(-10, -1.5, -1.5) * kMm, glm::dvec3(10, 1.5, 1.5) * kMm);
  SolidField field = SolidField::FromSurface(bar, kSpacing);
  SkinCarver carver(bar, field);
  field.Subtract({glm::dvec3(6, -3, -3) * kMm, glm::dvec3(9, 3, 3) * kMm},
                 [](const glm::dvec3& x) { return std::abs(x.x - 7.5 * kMm) - 0.5 * kMm; });
  const auto at_end = [&](const CarvedSkin& skin) {
    return std::ranges::count_if(skin.surface.vertices,
                                 [](const glm::dvec3& x) { return x.x > 7.7 * kMm; });
  };
  EXPECT_GT(at_end(carver.Carve(field)), 50);
  const FieldPieces pieces = PiecesOf(field);
  ASSERT_EQ(pieces.count(), 2);
  std::vector<unsigned char> is_debris(2, 0);
  is_debris[pieces.volume[0] < pieces.volume[1] ? 0 : 1] = 1;
  RemovePieces(field, pieces, is_debris);
  EXPECT_EQ(at_end(carver.Carve(field)), 0);
}

// A carver keeps the faces of the cuts it made last; what it makes of them must not depend on that.
TEST(CarvedSkin, CarvingOnEqualsCarvingAnew) {
  const SurfaceMesh whole = test::Sphere({0, 0, 0}, kRadius, 4);
  const SolidField uncut = SolidField::FromSurface(whole, kSpacing);
  SolidField field = uncut;
  SkinCarver kept(whole, uncut);
  std::vector<SolidField> states{uncut};
  for (int bite = 0; bite < 8; ++bite) {
    const glm::dvec3 at = kRadius * glm::normalize(glm::dvec3(std::cos(bite), std::sin(bite), 0.2));
    field.Subtract({at - 3.0 * kBite, at + 3.0 * kBite},
                   [&](const glm::dvec3& x) { return glm::distance(x, at) - kBite; });
    states.push_back(field);
  }
  states.push_back(states[3]);  // like an undo
  states.push_back(uncut);
  states.push_back(states[8]);
  for (std::size_t i = 0; i < states.size(); ++i) {
    const CarvedSkin on = kept.Carve(states[i]), anew = SkinCarver(whole, uncut).Carve(states[i]);
    EXPECT_EQ(on.surface.vertices, anew.surface.vertices) << i;
    EXPECT_EQ(on.surface.triangles, anew.surface.triangles) << i;
    EXPECT_EQ(on.is_fresh, anew.is_fresh) << i;
    EXPECT_EQ(on.whole_vertex, anew.whole_vertex) << i;
  }
}

TEST(CarvedSkin, IsTheSameEachTime) {
  const Bitten first, second;
  EXPECT_EQ(first.skin.surface.vertices, second.skin.surface.vertices);
  EXPECT_EQ(first.skin.surface.triangles, second.skin.surface.triangles);
}

}  // namespace
}  // namespace arthro::simulation

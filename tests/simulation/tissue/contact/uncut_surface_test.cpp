#include "simulation/tissue/contact/uncut_surface.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/core/random.h"
#include "simulation/tissue/contact/closest_points.h"
#include "simulation/tissue/field/polygonise.h"
#include "tests/support/shapes.h"

namespace arthro::simulation {
namespace {

constexpr double kMm = 1e-3;
const glm::dvec3 kHalf = glm::dvec3(6, 4, 2) * kMm;

// Distance from the surface of the box.
double OffBox(const glm::dvec3& x) {
  const glm::dvec3 q = glm::abs(x) - kHalf;
  return std::abs(glm::length(glm::max(q, glm::dvec3(0.0))) +
                  std::min(0.0, std::max({q.x, q.y, q.z})));
}

TEST(UncutSurface, SkinIsProjectedAwayFromCutsAndKeptNearThem) {
  const SurfaceMesh box = test::Box(-kHalf, kHalf);
  SolidField field = SolidField::FromSurface(box, 0.35 * kMm);
  const auto bite = [](const glm::dvec3& x) {
    return glm::distance(x, glm::dvec3(6, 0, 0) * kMm) - 1.5 * kMm;
  };
  field.Subtract(field.box(), bite);
  const SurfaceMesh raw = Polygonise(field);
  SurfaceMesh laid = raw;
  ProjectOnto(UncutSurface(box), field, {}, laid);
  double raw_worst = 0;
  for (std::size_t v = 0; v < raw.vertices.size(); ++v) {
    if (bite(raw.vertices[v]) < 0.3 * kMm) {  // relaxed
      EXPECT_LE(glm::distance(raw.vertices[v], laid.vertices[v]), 0.4 * 0.35 * kMm + 1e-12);
      continue;
    }
    if (bite(raw.vertices[v]) < 0.5 * kMm) continue;
    raw_worst = std::max(raw_worst, OffBox(raw.vertices[v]));
    EXPECT_LT(OffBox(laid.vertices[v]), 1e-9);
  }
  EXPECT_GT(raw_worst, 0.02 * kMm) << "the test needs an uneven surface";
}

// The tree of a fine skin, of which many triangles share one cell of the curve, misses none.
TEST(UncutSurface, NearestPointIsThatOfAllTriangles) {
  const SurfaceMesh skin = Polygonise(SolidField::FromSurface(test::Box(-kHalf, kHalf), 0.5 * kMm));
  const UncutSurface surface(skin);
  Random random(11);
  for (int i = 0; i < 50; ++i) {
    const glm::dvec3 x{random.Uniform(-8, 8) * kMm, random.Uniform(-6, 6) * kMm,
                       random.Uniform(-4, 4) * kMm};
    double least = 1.0;
    for (const auto& t : skin.triangles) {
      const TriangleCorners corner{skin.vertices[static_cast<std::size_t>(t[0])],
                                   skin.vertices[static_cast<std::size_t>(t[1])],
                                   skin.vertices[static_cast<std::size_t>(t[2])]};
      const glm::dvec3 at = ClosestOnTriangle(corner, x);
      least =
          std::min(least, glm::distance(at.x * corner[0] + at.y * corner[1] + at.z * corner[2], x));
    }
    EXPECT_NEAR(glm::distance(surface.Nearest(x, 1.0), x), least, 1e-15);
  }
}

TEST(UncutSurface, PointsOutOfReachStay) {
  const UncutSurface box(test::Box(-kHalf, kHalf));
  const glm::dvec3 inside(0, 0, 1 * kMm), near(0, 0, 1.8 * kMm);
  EXPECT_EQ(box.Nearest(inside, 0.3 * kMm), inside);
  EXPECT_LT(glm::distance(box.Nearest(near, 0.3 * kMm), glm::dvec3(0, 0, 2 * kMm)), 1e-15);
  EXPECT_EQ(UncutSurface(SurfaceMesh{}).Nearest(inside, 1.0), inside);
}

}  // namespace
}  // namespace arthro::simulation

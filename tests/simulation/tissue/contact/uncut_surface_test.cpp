#include "simulation/tissue/contact/uncut_surface.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

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
  ProjectOnto(SurfaceFinder(box), field, {}, laid);
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

}  // namespace
}  // namespace arthro::simulation

#include "simulation/tissue/fem/tet_shape.h"

#include <algorithm>
#include <random>
#include <utility>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace arthro::simulation {
namespace {

TEST(TetShape, BarycentricCoordinatesReproducePointsForEitherHandedness) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> in(-1.0, 2.0);
  double worst = 0;
  for (int i = 0; i < 1000; ++i) {
    std::array<glm::dvec3, 4> corner;
    for (glm::dvec3& x : corner) x = 1e-3 * glm::dvec3(in(random), in(random), in(random));
    if (i % 2 == 1) std::swap(corner[0], corner[1]);
    const glm::dvec3 l(in(random), in(random), in(random));
    const glm::dvec4 expected(1.0 - l.x - l.y - l.z, l);
    glm::dvec3 x(0.0);
    for (int k = 0; k < 4; ++k) x += expected[k] * corner[static_cast<std::size_t>(k)];
    const glm::dvec4 found = BarycentricIn(corner, x);
    glm::dvec3 back(0.0);
    for (int k = 0; k < 4; ++k) back += found[k] * corner[static_cast<std::size_t>(k)];
    EXPECT_NEAR(found.x + found.y + found.z + found.w, 1.0, 1e-9);
    worst = std::max(worst, glm::distance(back, x));
  }
  // Rounding of 1e-16 of some mm, times the flatness of the flattest of a thousand, at most 1e5.
  EXPECT_LT(worst, 1e-13);
}

TEST(TetShape, FlatTetrahedronContainsNoPoint) {
  const std::array<glm::dvec3, 4> flat{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}};
  EXPECT_EQ(BarycentricIn(flat, {0.25, 0.25, 0}), glm::dvec4(-1.0));
}

}  // namespace
}  // namespace arthro::simulation

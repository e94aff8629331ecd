#include "authoring/tissue/surface/fine_places.h"

#include <algorithm>
#include <cstdio>
#include <limits>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "authoring/tissue/tetrahedra/mesh_budget.h"
#include "simulation/core/error.h"
#include "tests/support/build_paths.h"
#include "tests/support/shapes.h"

namespace arthro::authoring {
namespace {

TEST(FinePlaces, TouchASurfaceFromOutsideAndFromInside) {
  const SurfaceMesh box = test::Box({0, 0, 0}, {0.01, 0.01, 0.01});
  EXPECT_TRUE(Touches({{-0.001, 0.005, 0.005}, 0.0011}, box));
  EXPECT_FALSE(Touches({{-0.001, 0.005, 0.005}, 0.0009}, box));
  EXPECT_TRUE(Touches({{0.005, 0.005, 0.005}, 0.0001}, box)) << "deep inside, off every triangle";
  EXPECT_FALSE(Touches({{0.012, 0.012, 0.012}, 0.003}, box)) << "past the corner";
}

TEST(FinePlaces, AreRefusedWithTheirNumberWhenInvalidOrTouchingNothing) {
  const SurfaceMesh box = test::Box({0, 0, 0}, {0.01, 0.01, 0.01});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto says = [&](const Ball& ball) {
    try {
      RequireTouching(std::vector<Ball>{{{0, 0, 0}, 0.001}, ball}, box, "a probed place", {});
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), Code::kBadArgument);
      return error.sentence();
    }
    return std::string("nothing");
  };
  EXPECT_NE(says({{nan, 0, 0}, 0.001}).find("number 2, is not a number"), std::string::npos);
  EXPECT_NE(says({{0, 0, 0}, nan}).find("is not a number"), std::string::npos);
  EXPECT_NE(says({{0, 0, 0}, -0.001}).find("has no radius"), std::string::npos);
  EXPECT_NE(says({{0.5, 0, 0}, 0.001}).find("(500, 0, 0) mm, does not touch"), std::string::npos);
  EXPECT_NE(says({{0.5, 0, 0}, 0.001}).find("from (0, 0, 0) to (10, 10, 10) mm"),
            std::string::npos);
  EXPECT_EQ(says({{0.01, 0, 0}, 0.001}), "nothing");
}

// The number of elements is the same, but more of their nodes lie where the tissue is probed.
TEST(FinePlaces, GetMoreNodesOfABudget) {
  const SurfaceMesh torus = test::Torus(0.015, 0.004, 60, 24);
  const Ball place{{-0.011, 0, 0}, 0.0015};
  const auto nodes_near = [&](const std::vector<Ball>& probed) {
    MeshWish wish;
    wish.fixed = {{{0.015, 0, 0}, 0.006}};
    wish.probed = probed;
    TetrahedralizeReport report;
    const TetMesh mesh = TetrahedralizeToBudget(torus, {}, wish, &report, {}, ARTHRO_PROGRAM);
    EXPECT_NEAR(mesh.ElementCount(), wish.elements, 0.2 * wish.elements);
    EXPECT_EQ(report.quality.inverted, 0);
    return std::ranges::count_if(mesh.rest_positions, [&](const glm::dvec3& x) {
      return glm::distance(x, place.centre) < 0.003;
    });
  };
  const auto even = nodes_near({}), fine = nodes_near({place});
  std::printf("nodes within 3 mm of where it is probed: %td, %td if not said\n", fine, even);
  EXPECT_GT(fine, 2 * even);
}

}  // namespace
}  // namespace arthro::authoring

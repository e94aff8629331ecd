// Tissue behind the relief.
#include "simulation/scene/backdrop/hidden_share.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/support/small_scene.h"

namespace arthro {
namespace {

// A picture of 91° about straight ahead, 1 px per degree, before a sphere of 50 mm.
Backdrop Wall() {
  Backdrop backdrop;
  backdrop.radius = 0.05;
  backdrop.projection.type = ProjectionType::kEquirectangular;
  backdrop.projection.centre_px = {45, 45};
  backdrop.projection.px_per_deg = 1;
  return backdrop;
}

Pose At(double z) { return {{0, 0, z}}; }

TEST(HiddenShare, IsNoneBeforeTheReliefAndAllBehindIt) {
  const SurfaceMesh body = test::Octahedron(0.004);
  const DepthMap relief(91, 91, 0.01f);  // 40 mm from the portal
  EXPECT_EQ(HiddenShare(body, At(0.03), relief, Wall()), 0);
  EXPECT_EQ(HiddenShare(body, At(0.046), relief, Wall()), 1);
  // Half way in: the corner that is furthest in, and the four beside the middle, lie behind.
  EXPECT_NEAR(HiddenShare(body, At(0.04), relief, Wall()), 5.0 / 6.0, 1e-12);
}

TEST(HiddenShare, TheBareSphereHidesToo) {
  const SurfaceMesh body = test::Octahedron(0.004);
  EXPECT_EQ(HiddenShare(body, At(0.04), {}, Wall()), 0);
  EXPECT_EQ(HiddenShare(body, At(0.06), {}, Wall()), 1);
}

TEST(HiddenShare, NothingHidesWhereNothingWasImaged) {
  const SurfaceMesh body = test::Octahedron(0.004);
  const DepthMap holes(91, 91, std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(HiddenShare(body, At(0.06), holes, Wall()), 0);
  EXPECT_EQ(HiddenShare(body, {{0.06, 0, 0}}, DepthMap(91, 91, 0.01f), Wall()), 0)
      << "beside the picture";
  EXPECT_EQ(HiddenShare({}, At(0.06), holes, Wall()), 0);
}

}  // namespace
}  // namespace arthro

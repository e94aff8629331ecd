// simulation/scope and the reference tracer were derived apart; here they are held against one
// another, and the grid measurement against pictures whose error is known.
#include "tests/support/view/reference_tracer.h"

#include <cmath>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/core/units.h"
#include "simulation/scene/projection.h"
#include "tests/support/view/grid_picture.h"

namespace arthro::test {
namespace {

using namespace simulation;

constexpr double kFov = 90.0 * kRadianPerDegree;

Backdrop GnomonicBackdrop() {
  Backdrop backdrop;
  backdrop.projection = {ProjectionType::kGnomonic, {1023.5, 511.5}, 500, 0};
  return backdrop;
}

Backdrop EquirectangularBackdrop() {
  Backdrop backdrop;
  backdrop.projection = {ProjectionType::kEquirectangular, {1023.5, 511.5}, 0, 11};
  return backdrop;
}

ReferencePose RandomPose(std::mt19937& random) {
  const auto between = [&](double a, double b) {
    return a + (b - a) * static_cast<double>(random()) / 4294967295.0;
  };
  ReferencePose pose{between(-1.5, 1.5),     between(-3.1, 3.1), between(-7, 7),
                     between(-0.04, 0.0499), between(0.0, 1.6),  std::nullopt};
  if (random() % 2) pose.head_roll = between(-4, 4);
  return pose;
}

ScopeView ScopeViewOf(const ReferencePose& pose) {
  return ViewFromPose({pose.latitude, pose.longitude, pose.roll, pose.depth}, pose.view_angle,
                      pose.head_roll);
}

// Both are closed forms of a few operations on numbers up to 1: rounding alone may part them.
TEST(ReferenceTracer, AgreesWithTheScopeOnView) {
  std::mt19937 random(1);
  for (int i = 0; i < 2000; ++i) {
    const ReferencePose pose = RandomPose(random);
    const ScopeView a = ScopeViewOf(pose), b = ReferenceView(pose);
    ASSERT_LT(glm::length(a.tip - b.tip), 1e-14);
    ASSERT_LT(glm::length(a.view - b.view), 1e-13);
    ASSERT_LT(glm::length(a.up - b.up), 1e-13);
    ASSERT_LT(glm::length(a.right - b.right), 1e-13);
  }
}

TEST(ReferenceTracer, AgreesWithTheScopeOnEveryPixelOfTheWindow) {
  std::mt19937 random(2);
  double worst = 0.0;
  int compared = 0;
  for (int i = 0; i < 40; ++i) {
    const ReferencePose pose = RandomPose(random);
    const ScopeView view = ScopeViewOf(pose);
    for (const int size : {97, 128}) {
      const RoundWindow window = WindowOfSize(kFov, size);
      for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
          const auto a = RayFromPixel(window, view, {x, y});
          const auto b = ReferenceRay(ReferenceView(pose), kFov, size, {x, y});
          // The rim itself may fall to either side by rounding.
          const double r = std::hypot(x - 0.5 * (size - 1), y - 0.5 * (size - 1));
          if (std::abs(r - 0.5 * size) < 1e-9) continue;
          ASSERT_EQ(a.has_value(), b.has_value()) << x << " " << y;
          if (!a) continue;
          const auto hit = ReferenceSphereHit(view.tip, *b, 0.05);
          ASSERT_TRUE(hit);
          worst = std::max(worst, glm::length(SphereHit(view.tip, *a, 0.05) - *hit) / 0.05);
          ++compared;
        }
    }
  }
  std::printf("%d rays: at most %.1e rad apart on the backdrop\n", compared, worst);
  // A tip 0.1 mm inside the sphere meets it at a grazing angle in the worst of these poses, which
  // magnifies rounding (1e-16) by the square root of D over that distance.
  EXPECT_LT(worst, 1e-13);
}

TEST(ReferenceTracer, AgreesWithTheProjection) {
  std::mt19937 random(3);
  for (const Backdrop& backdrop : {GnomonicBackdrop(), EquirectangularBackdrop()})
    for (int i = 0; i < 1000; ++i) {
      const glm::dvec3 direction = ReferenceView(RandomPose(random)).view;
      const auto a = PixelFromDirection(backdrop.projection, direction);
      const auto b = ReferencePixel(backdrop.projection, direction);
      ASSERT_EQ(a.has_value(), b.has_value());
      if (!a) continue;
      EXPECT_LT(glm::length(*a - *b), 1e-7 * (1.0 + glm::length(*a)));
    }
}

TEST(ReferenceTracer, SphereIsMetAheadOnly) {
  EXPECT_FALSE(ReferenceSphereHit({0, 0, 0.08}, {0, 0, 1}, 0.05));
  EXPECT_FALSE(ReferenceSphereHit({0, 0, 0.08}, {1, 0, 0}, 0.05));
  const auto through = ReferenceSphereHit({0, 0, -0.08}, {0, 0, 1}, 0.05);
  ASSERT_TRUE(through);
  EXPECT_NEAR(through->z, 0.05, 1e-15);
}

TEST(ReferenceTracer, ColourIsBilinearAndBlackBeyondThePanorama) {
  ColourImage image(2, 2);
  image.at(0, 0)[0] = 40;
  image.at(1, 0)[0] = 80;
  image.at(1, 1)[0] = 120;
  EXPECT_NEAR(ReferenceColour(image, {0.5, 0.0}).r, 60.0, 1e-12);
  EXPECT_NEAR(ReferenceColour(image, {0.5, 0.5}).r, 60.0, 1e-12);
  EXPECT_NEAR(ReferenceColour(image, {1.4, 0.0}).r, 80.0, 1e-12);
  EXPECT_EQ(ReferenceColour(image, {1.6, 0.0}).r, 0.0);
}

// A square of 10 mm, 20 mm ahead of a forward scope in the portal: its edge is seen at
// atan(5/20) = 14.04 degrees.
TEST(ReferenceTracer, ClosestMeshHidesTheBackdrop) {
  SurfaceMesh square;
  square.vertices = {
      {-0.005, -0.005, 0.02}, {0.005, -0.005, 0.02}, {0.005, 0.005, 0.02}, {-0.005, 0.005, 0.02}};
  square.triangles = {{0, 1, 2}, {0, 2, 3}};
  SurfaceMesh behind = square;
  for (glm::dvec3& vertex : behind.vertices) vertex = 1.5 * vertex;  // the same outline, further
  const ReferenceMesh meshes[] = {{&behind, {0, 255, 0}}, {&square, {255, 0, 0}}};
  const int size = 401;
  const TracedPicture picture = TraceWindow(EquirectangularBackdrop(), ColourImage(2048, 1024),
                                            ReferenceView({}), kFov, size, meshes);
  const double edge_px = 200.5 * std::sin(std::atan(0.25) / 2) / std::sin(kFov / 4);
  int right = 0;
  for (int x = 200; x < size; ++x) right += picture.what[200 * size + x] == 2;
  EXPECT_NEAR(right - 0.5, edge_px, 0.5);  // whole pixels from the centre's own half
  EXPECT_NEAR(picture.distance[200 * size + 200], 0.02, 1e-12);
  EXPECT_EQ(picture.colours.at(200, 200)[0], 255);
  EXPECT_EQ(picture.what[200 * size + 380], TracedPicture::kBackdrop);
  EXPECT_EQ(picture.what[0], TracedPicture::kOutside);
  for (int what : picture.what) EXPECT_NE(what, 1) << "the further square shows";
}

class GridPicture : public ::testing::TestWithParam<ReferencePose> {};

// 8-bit colours and bilinear reading cost the measurement some hundredths of a pixel; the picture
// test of the renderer allows 0.5.
TEST_P(GridPicture, TracedGridIsMeasuredWhereTheClosedFormPutsIt) {
  for (const Backdrop& backdrop : {GnomonicBackdrop(), EquirectangularBackdrop()}) {
    const GridPanorama grid;
    const ScopeView view = ReferenceView(GetParam());
    const TracedPicture picture = TraceWindow(backdrop, grid.Draw(), view, kFov, 512);
    const GridAgreement agreement = CompareWithGrid(picture.colours, grid, backdrop, view, kFov);
    std::printf("%d crossings: rms %.4f px, max %.4f px; %d of %d cell pixels wrong\n",
                agreement.crossings, agreement.rms_px, agreement.max_px, agreement.wrong_cells,
                agreement.cells);
    EXPECT_GT(agreement.crossings, 1000);
    EXPECT_GT(agreement.cells, 5000);
    EXPECT_LT(agreement.max_px, 0.2);
    EXPECT_EQ(agreement.wrong_cells, 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Poses, GridPicture,
                         ::testing::Values(ReferencePose{0.0, 0.0, 0.0, 0.0, 0.0, std::nullopt},
                                           ReferencePose{0.1, -0.2, 0.7, 0.01, 0.5, std::nullopt},
                                           ReferencePose{-0.2, 0.1, 2.5, 0.02, 0.6, 1.0}));

// The picture must fail where the renderer is wrong, or the comparison proves nothing.
TEST(GridPictureMustFail, SmallAndLargeErrorsAreSeen) {
  const Backdrop backdrop = GnomonicBackdrop();
  const GridPanorama grid;
  const ScopeView right = ReferenceView({0.1, -0.2, 0.7, 0.01, 0.5, std::nullopt});
  const auto compare = [&](const ScopeView& wrong, double fov = kFov) {
    const TracedPicture picture = TraceWindow(backdrop, grid.Draw(), wrong, fov, 512);
    return CompareWithGrid(picture.colours, grid, backdrop, right, kFov);
  };
  // A roll of 0.2 degrees moves the rim by 0.9 px.
  EXPECT_GT(compare(ReferenceView({0.1, -0.2, 0.7035, 0.01, 0.5, std::nullopt})).max_px, 0.5);
  EXPECT_GT(compare(right, 1.005 * kFov).max_px, 0.5);
  // A whole cell: the lines fall on lines again near the centre, the cells do not.
  Backdrop shifted = backdrop;
  shifted.projection.centre_px.x += grid.spacing;
  const TracedPicture picture = TraceWindow(shifted, grid.Draw(), right, kFov, 512);
  const GridAgreement agreement = CompareWithGrid(picture.colours, grid, backdrop, right, kFov);
  EXPECT_LT(agreement.rms_px, 0.1);
  EXPECT_GT(agreement.wrong_cells, agreement.cells / 2);
}

}  // namespace
}  // namespace arthro::test

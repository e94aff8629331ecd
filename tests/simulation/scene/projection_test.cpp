#include "simulation/scene/projection.h"

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/core/units.h"

namespace arthro {
namespace {

Projection Gnomonic() { return {ProjectionType::kGnomonic, {2048, 1024}, 1500, 0}; }
Projection Equirectangular() { return {ProjectionType::kEquirectangular, {1000, 700}, 0, 10}; }

glm::dvec3 Towards(double latitude_deg, double longitude_deg) {
  const double phi = RadiansFromDegrees(latitude_deg), lambda = RadiansFromDegrees(longitude_deg);
  return {std::cos(phi) * std::sin(lambda), -std::sin(phi), std::cos(phi) * std::cos(lambda)};
}

TEST(Projection, EquirectangularIsLatitudeAndLongitude) {
  const auto pixel = PixelFromDirection(Equirectangular(), Towards(20.0, -35.0));
  ASSERT_TRUE(pixel);
  EXPECT_NEAR(pixel->x, 1000 - 350, 1e-9);
  EXPECT_NEAR(pixel->y, 700 - 200, 1e-9);
}

// A turned picture is the picture of turned directions, and its gradients are those of its pixels.
TEST(Projection, RollTurnsThePictureAboutTheDirectionStraightAhead) {
  for (Projection projection : {Gnomonic(), Equirectangular()}) {
    const glm::dvec3 ahead = DirectionFromPixel(projection, projection.centre_px);
    const glm::dvec2 right = projection.centre_px + glm::dvec2(80, 0);
    projection.roll = RadiansFromDegrees(90);
    EXPECT_LT(glm::distance(DirectionFromPixel(projection, projection.centre_px), ahead), 1e-15);
    const glm::dvec3 below = DirectionFromPixel(projection, right);
    EXPECT_NEAR(below.x, 0, 1e-12) << "clockwise: what was right is below";
    EXPECT_GT(below.y, 0);
    projection.roll = 0.7;
    const glm::dvec3 d = glm::normalize(glm::dvec3(0.2, -0.3, 0.9));
    const auto pixel = PixelFromDirection(projection, d);
    ASSERT_TRUE(pixel);
    EXPECT_LT(glm::distance(DirectionFromPixel(projection, *pixel), d), 1e-12);
    constexpr double kStep = 1e-6;
    const glm::dmat2x3 gradients = PixelGradients(projection, d);
    for (int axis = 0; axis < 3; ++axis) {
      glm::dvec3 step(0.0);
      step[axis] = kStep;
      const glm::dvec2 change =
          (*PixelFromDirection(projection, d + step) - *PixelFromDirection(projection, d - step)) /
          (2 * kStep);
      // Central differences: error of the third derivative, some 1e4 px times kStep².
      EXPECT_NEAR(change.x, gradients[0][axis], 1e-4);
      EXPECT_NEAR(change.y, gradients[1][axis], 1e-4);
    }
  }
}

TEST(Projection, GnomonicIsThePinhole) {
  const auto pixel = PixelFromDirection(Gnomonic(), {0.02, -0.01, 0.1});
  ASSERT_TRUE(pixel);
  EXPECT_NEAR(pixel->x, 2048 + 300, 1e-9);
  EXPECT_NEAR(pixel->y, 1024 - 150, 1e-9);
  EXPECT_FALSE(PixelFromDirection(Gnomonic(), {0.1, 0.0, 0.0}));
  EXPECT_FALSE(PixelFromDirection(Gnomonic(), {0.0, 0.0, -1.0}));
  EXPECT_FALSE(PixelFromDirection(Equirectangular(), {0.0, 0.0, 0.0}));
}

// cos 90° is 6e-17 in doubles, not 0: without a margin the pixel would be 1e19.
TEST(Projection, GnomonicHasNoPixelForARightAngle) {
  const glm::dvec3 aside(1.0, 0.0, std::cos(std::numbers::pi / 2));
  ASSERT_GT(aside.z, 0.0);
  EXPECT_FALSE(PixelFromDirection(Gnomonic(), aside));
}

TEST(Projection, DirectionAndPixelAreInverse) {
  for (const Projection& projection : {Gnomonic(), Equirectangular()})
    for (double latitude = -60; latitude <= 60; latitude += 15)
      for (double longitude = -75; longitude <= 75; longitude += 15) {
        const glm::dvec3 direction = Towards(latitude, longitude);
        const auto pixel = PixelFromDirection(projection, 0.03 * direction);
        ASSERT_TRUE(pixel);
        EXPECT_LT(glm::length(DirectionFromPixel(projection, *pixel) - direction), 1e-12);
      }
}

TEST(Projection, GradientsAreDerivatives) {
  for (const Projection& projection : {Gnomonic(), Equirectangular()})
    for (double latitude : {-70.0, -10.0, 0.0, 42.0})
      for (double longitude : {-80.0, 5.0, 60.0}) {
        const glm::dvec3 d = 0.04 * Towards(latitude, longitude);
        const glm::dmat2x3 gradients = PixelGradients(projection, d);
        constexpr double kStep = 1e-7;
        for (int axis = 0; axis < 3; ++axis) {
          glm::dvec3 step(0.0);
          step[axis] = kStep;
          const glm::dvec2 slope = (*PixelFromDirection(projection, d + step) -
                                    *PixelFromDirection(projection, d - step)) /
                                   (2.0 * kStep);
          // Central differences are good to h² f'''/6, about 1e-5 of the slope at the steepest
          // point here.
          EXPECT_NEAR(gradients[0][axis], slope.x, 1e-5 * (1.0 + std::abs(slope.x)));
          EXPECT_NEAR(gradients[1][axis], slope.y, 1e-5 * (1.0 + std::abs(slope.y)));
        }
      }
}

TEST(Projection, LongerGradientIsThatOfTheUnitDirection) {
  Projection rolled = Gnomonic();
  rolled.roll = 0.7;
  for (const Projection& projection : {Gnomonic(), rolled, Equirectangular()})
    for (double latitude : {-70.0, -10.0, 0.0, 42.0})
      for (double longitude : {-80.0, 5.0, 60.0}) {
        const glm::dvec3 d = Towards(latitude, longitude);
        const glm::dmat2x3 gradients = PixelGradients(projection, d);
        const double longer = std::max(glm::length(gradients[0]), glm::length(gradients[1]));
        EXPECT_NEAR(LongerPixelGradient(projection, *PixelFromDirection(projection, d)), longer,
                    1e-10 * longer);
      }
}

}  // namespace
}  // namespace arthro

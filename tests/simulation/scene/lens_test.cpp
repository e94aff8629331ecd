#include "simulation/scene/lens.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/core/units.h"

namespace arthro {
namespace {

Lens Plain(LensModel model, std::array<double, 4> k = {}) {
  Lens lens;
  lens.model = model;
  lens.width = 800;
  lens.height = 640;
  lens.focal_px = 466.65;
  lens.cx = 402.5;
  lens.cy = 317.25;
  lens.aspect = 1.03;
  lens.k = k;
  return lens;
}

std::vector<Lens> AllModels() {
  return {Plain(LensModel::kEquisolid),
          Plain(LensModel::kPinhole),
          Plain(LensModel::kKannalaBrandt, {-0.04, 0.002, 0, 0}),
          Plain(LensModel::kKannalaBrandt, {0.1, 0.02, 0.003, 0.001}),
          Plain(LensModel::kDoubleSphere, {-0.2, 0.58, 0, 0}),
          Plain(LensModel::kDoubleSphere, {0.3, 0.4, 0, 0})};
}

// Rounding alone: 1e-9 rad is half a millionth of a pixel.
TEST(Lens, RayAndPixelAreInverse) {
  for (const Lens& lens : AllModels())
    for (double theta = 0; theta < 1.4; theta += 0.013)
      for (double phi = 0.1; phi < 6.3; phi += 0.77) {
        const glm::dvec3 ray(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                             std::cos(theta));
        const auto pixel = PixelFromRay(lens, 3.7 * ray);
        ASSERT_TRUE(pixel);
        const auto back = RayFromPixel(lens, *pixel);
        ASSERT_TRUE(back);
        EXPECT_LT(glm::length(*back - ray), 1e-9) << static_cast<int>(lens.model) << " " << theta;
        const auto again = PixelFromRay(lens, *back);
        ASSERT_TRUE(again);
        // Near 80 degrees a pinhole's pixel moves 15 000 px a radian.
        EXPECT_LT(glm::length(*again - *pixel), 1e-9 * (1 + glm::length(*pixel)));
      }
}

TEST(Lens, EquisolidIsTheFormulaOfThePaper) {
  const Lens lens = Plain(LensModel::kEquisolid);
  const double theta = RadiansFromDegrees(40);
  const auto pixel = PixelFromRay(lens, {0, std::sin(theta), std::cos(theta)});
  ASSERT_TRUE(pixel);
  EXPECT_NEAR(pixel->x, 402.5, 1e-12);
  EXPECT_NEAR((pixel->y - 317.25) * 1.03, 2 * 466.65 * std::sin(theta / 2), 1e-9);
}

TEST(Lens, PinholeAndDoubleSphereWithoutSpheresAgree) {
  const Lens pinhole = Plain(LensModel::kPinhole);
  const Lens sphere = Plain(LensModel::kDoubleSphere, {0, 0, 0, 0});
  for (const glm::dvec3 ray : {glm::dvec3(0.3, -0.2, 1), glm::dvec3(-2, 1, 1.5)}) {
    EXPECT_LT(glm::length(*PixelFromRay(pinhole, ray) - *PixelFromRay(sphere, ray)), 1e-9);
  }
}

// Beyond the summit of its polynomial two rays would share one pixel.
TEST(Lens, KannalaBrandtEndsWhereItStopsRising) {
  const Lens lens = Plain(LensModel::kKannalaBrandt, {-0.3, 0, 0, 0});  // summit: θ² = 1/0.9
  const double summit = std::sqrt(1 / 0.9);
  EXPECT_TRUE(RadiusFromAngle(lens, summit - 1e-3));
  EXPECT_FALSE(RadiusFromAngle(lens, summit + 1e-3));
  const double largest = 466.65 * summit * (1 - 0.3 * summit * summit);
  EXPECT_FALSE(AngleFromRadius(lens, largest + 1e-3));
  const auto theta = AngleFromRadius(lens, largest - 1e-3);
  ASSERT_TRUE(theta);
  EXPECT_LT(*theta, summit);
  EXPECT_NEAR(*RadiusFromAngle(lens, *theta), largest - 1e-3, 1e-9);
}

TEST(Lens, NothingWhereTheModelHasNothing) {
  EXPECT_FALSE(PixelFromRay(Plain(LensModel::kPinhole), {0, 1, 0}));
  EXPECT_FALSE(PixelFromRay(Plain(LensModel::kPinhole), {0, 0, -1}));
  EXPECT_FALSE(RayFromPixel(Plain(LensModel::kEquisolid), {402.5 + 2 * 466.65 + 1, 317.25}));
  EXPECT_FALSE(RayFromPixel(Plain(LensModel::kDoubleSphere, {0, 0.9, 0, 0}), {1402.5, 317.25}));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Lens& lens : AllModels()) {
    EXPECT_FALSE(PixelFromRay(lens, {0, 0, 0}));
    EXPECT_FALSE(PixelFromRay(lens, {nan, 0, 1}));
    EXPECT_FALSE(RayFromPixel(lens, {nan, 0}));
    EXPECT_FALSE(RayFromPixel(lens, {std::numeric_limits<double>::infinity(), 0}));
  }
  Lens none = Plain(LensModel::kEquisolid);
  none.focal_px = 0;
  EXPECT_FALSE(PixelFromRay(none, {0, 0, 1}));
  EXPECT_FALSE(RayFromPixel(none, {0, 0}));
}

TEST(Lens, FocalAtTheAxisIsTheSlopeThere) {
  constexpr double kSmall = 1e-5;  // rad; the cubic term is then 1e-10 of the slope
  for (const Lens& lens : AllModels())
    EXPECT_NEAR(*RadiusFromAngle(lens, kSmall) / kSmall, FocalAtAxis(lens), 1e-5);
}

TEST(Lens, FieldOfViewReachesTheRim) {
  Lens lens = Plain(LensModel::kEquisolid);
  lens.circle = {400, 320, 2 * 466.65 * std::sin(RadiansFromDegrees(37.5) / 2)};
  EXPECT_NEAR(*FieldOfViewOf(lens), RadiansFromDegrees(75), 1e-12);
  lens.circle = {};
  EXPECT_GT(*FieldOfViewOf(lens), RadiansFromDegrees(75));  // to the corner
}

}  // namespace
}  // namespace arthro

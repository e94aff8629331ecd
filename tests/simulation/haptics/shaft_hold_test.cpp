// Shaft of an instrument beside and behind a ridge of the relief.
#include "simulation/haptics/relief/shaft_hold.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/core/units.h"

namespace arthro::simulation {
namespace {

constexpr double kRadius = 0.05;  // m
constexpr glm::dvec3 kPortal{0.018, 0, 0};
constexpr int kWidth = 720, kHeight = 360;  // 3 px per degree

// A ridge along the longitude -5 degrees, as wide as a condyle: `height` m over 8 degrees to either
// side.
struct Ridge {
  explicit Ridge(double height) : map(kWidth, kHeight) {
    backdrop.radius = kRadius;
    backdrop.projection = {ProjectionType::kEquirectangular, {359.5, 179.5}, 0, 3};
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const double off = ((x - 359.5) / 3 + 5) / 8;
        map.at(x, y) = static_cast<float>(height * std::exp(-off * off));
      }
    field = DepthField(backdrop, map);
  }
  // Reference: deepest of evenly spaced points of the line, 0.05 mm apart.
  double Deepest(const glm::dvec3& tip) const {
    const double length = glm::distance(kPortal, tip);
    double deepest = 0;
    for (double along = 0; along < length - kShaftFree; along += 5e-5) {
      const FieldQuery query = field.Query(kPortal + along / length * (tip - kPortal));
      if (query.weight > 0) deepest = std::max(deepest, -query.clearance);
    }
    return deepest;
  }
  Backdrop backdrop;
  DepthMap map;
  DepthField field;
};

glm::dvec3 Behind(double longitude_deg, double latitude_deg, double radius) {
  const double longitude = RadiansFromDegrees(longitude_deg),
               latitude = RadiansFromDegrees(latitude_deg);
  return radius * glm::dvec3(std::cos(latitude) * std::sin(longitude), -std::sin(latitude),
                             std::cos(latitude) * std::cos(longitude));
}

TEST(ShaftHold, FreeShaftStaysWhereItIs) {
  const Ridge ridge(0.026);
  const glm::dvec3 before = Behind(10, 5, 0.045);
  const ShaftHold hold = HoldShaft(ridge.field, kPortal, before);
  EXPECT_EQ(hold.tip, before);
  EXPECT_EQ(hold.held, 0);
  EXPECT_EQ(hold.through, 0);
  EXPECT_EQ(HoldShaft(DepthField(), kPortal, before).tip, before);
}

TEST(ShaftHold, TurnsTheRodOutOfARidgeAndKeepsItsLength) {
  const Ridge ridge(0.026);
  int held = 0;
  for (double longitude = -45; longitude <= 0; longitude += 1)
    for (double radius = 0.03; radius < 0.049; radius += 0.002) {
      const glm::dvec3 tip = Behind(longitude, 4, radius);
      if (ridge.field.Query(tip).clearance < 0) continue;
      const ShaftHold hold = HoldShaft(ridge.field, kPortal, tip);
      if (hold.through > 0) continue;
      // Points 1 mm apart and eight refinements miss the deepest by less than a hundredth.
      EXPECT_LT(ridge.Deepest(hold.tip), kShaftGraze + 1e-5) << longitude << " " << radius;
      EXPECT_NEAR(glm::distance(hold.tip, kPortal), glm::distance(tip, kPortal), 1e-12);
      EXPECT_DOUBLE_EQ(glm::distance(hold.tip, tip), hold.held);
      if (hold.held > 0) ++held;
    }
  EXPECT_GT(held, 50) << "the tips of this test do not lie behind the ridge";
}

TEST(ShaftHold, FollowsATipThatMovesWithoutAJump) {
  const Ridge ridge(0.024);
  glm::dvec3 last(0);
  double most = 0;
  for (double longitude = 0; longitude > -40; longitude -= 0.01) {
    const glm::dvec3 tip = Behind(longitude, 4, 0.047);
    if (ridge.field.Query(tip).clearance < 0) continue;
    const ShaftHold hold = HoldShaft(ridge.field, kPortal, tip);
    ASSERT_EQ(hold.through, 0) << longitude;
    if (last != glm::dvec3(0)) most = std::max(most, glm::distance(hold.tip, last));
    last = hold.tip;
  }
  // 0.01 degrees are 0.008 mm. The point that holds the shaft moves with the tip, by less than the
  // distance of a pixel of the relief, 0.2 mm.
  EXPECT_LT(most, 2e-4);
}

TEST(ShaftHold, SaysHowDeepAShaftIsThatNoSmallTurnFrees) {
  const Ridge ridge(0.034);
  const glm::dvec3 tip = Behind(-25, 4, 0.048);
  const ShaftHold hold = HoldShaft(ridge.field, kPortal, tip);
  EXPECT_EQ(hold.tip, tip);
  EXPECT_EQ(hold.held, 0);
  EXPECT_NEAR(hold.through, ridge.Deepest(tip), 1e-4);
  EXPECT_GT(hold.through, 5e-3);
}

TEST(ShaftHold, PassesThroughTheWallBesideThePortal) {
  // The portal lies 2 mm deep in the relief of the whole sphere.
  Ridge ridge(0);
  std::fill(ridge.map.relief.begin(), ridge.map.relief.end(), 0.034f);
  const DepthField field(ridge.backdrop, ridge.map);
  const glm::dvec3 tip(0.002, 0, 0.012);
  ASSERT_LT(field.Query(kPortal).clearance, -1e-3);
  EXPECT_EQ(HoldShaft(field, kPortal, tip).tip, tip);
  EXPECT_EQ(HoldShaft(field, kPortal, tip).through, 0);
}

}  // namespace
}  // namespace arthro::simulation

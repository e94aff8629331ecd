#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include "authoring/relief/editing/relief_profile.h"
#include "tests/authoring/relief/editing/small_relief.h"

namespace arthro::authoring {
namespace {

constexpr double kFloat = 1e-8;  // m, rounding of a float at 0.04 m

TEST(ReliefReading, HoldsRangeUncertaintyAndOriginOfTheNearestCell) {
  test::SmallRelief made;
  made.relief.at(12, 7) = 0.003f;
  made.sigma.at(12, 7) = 2e-4f;
  made.origin.at(12, 7) = ReliefOrigin::kBrightness;
  const ReliefReading reading = ReadRelief(made.view(), {12.3, 6.6});
  EXPECT_NEAR(reading.range, 0.037, kFloat);
  EXPECT_NEAR(reading.sigma, 2e-4, kFloat);
  EXPECT_EQ(reading.origin, ReliefOrigin::kBrightness);
  EXPECT_NEAR(glm::length(reading.point), 0.037, kFloat);
}

TEST(ReliefReading, IsUnknownOutsideAndWhereNothingWasImaged) {
  test::SmallRelief made;
  made.relief.at(3, 3) = std::numeric_limits<float>::quiet_NaN();
  for (const glm::dvec2 pixel : {glm::dvec2(3, 3), glm::dvec2(-1, 5), glm::dvec2(61, 5),
                                 glm::dvec2(5, std::nan("")), glm::dvec2(1e300, 0)})
    EXPECT_TRUE(std::isnan(ReadRelief(made.view(), pixel).range));
}

TEST(ReliefReading, OfAReliefWithoutUncertaintyHasNone) {
  const test::SmallRelief made;
  const DepthMap no_sigma;
  const OriginMap no_origin;
  const ReliefReading reading =
      ReadRelief({made.relief, no_sigma, no_origin, made.projection, made.kRadius}, {4, 4});
  EXPECT_TRUE(std::isnan(reading.sigma));
  EXPECT_EQ(reading.origin, ReliefOrigin::kNone);
}

TEST(ReliefProfile, FollowsAPlaneFromEndToEnd) {
  test::SmallRelief made;
  made.MakePlane(0.03);
  const auto samples = SampleProfile(made.view(), {0, 20}, {60, 20});
  ASSERT_EQ(samples.size(), 61u);
  for (const ProfileSample& sample : samples) EXPECT_NEAR(sample.reading.point.z, 0.03, kFloat);
  EXPECT_EQ(samples.front().angle, 0);
  // 60 cells of half a degree on the equator.
  EXPECT_NEAR(samples.back().angle, glm::radians(30.0), 1e-9);
  const RangeSpan span = RangesOf(samples);
  EXPECT_NEAR(span.nearest, 0.03 - 1e-4, kFloat);
  EXPECT_NEAR(span.furthest, 0.03 / std::cos(glm::radians(15.0)) + 1e-4, kFloat);
}

TEST(ReliefProfile, KeepsItsGapsAndItsNumberOfSamples) {
  test::SmallRelief made;
  made.relief.at(30, 20) = std::numeric_limits<float>::quiet_NaN();
  const auto samples = SampleProfile(made.view(), {0, 20}, {60, 20}, 31);
  ASSERT_EQ(samples.size(), 31u);
  EXPECT_TRUE(std::isnan(samples[15].reading.range));
  EXPECT_FALSE(std::isnan(samples[14].reading.range));
  EXPECT_TRUE(SampleProfile(made.view(), {5, 5}, {5.5, 5}).empty()) << "shorter than a pixel";
}

}  // namespace
}  // namespace arthro::authoring

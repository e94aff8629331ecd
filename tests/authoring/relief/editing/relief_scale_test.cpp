#include "authoring/relief/editing/relief_scale.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/core/error.h"
#include "tests/authoring/relief/editing/small_relief.h"

namespace arthro::authoring {
namespace {

std::string Refusal(const ReliefView& view, const KnownLength& known) {
  try {
    ScaleFromLength(view, known);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Code::kBadArgument);
    return error.sentence();
  }
  return "";
}

TEST(ReliefScale, MakesAKnownDistanceTrue) {
  test::SmallRelief made;
  made.MakePlane(0.03);
  const double now = glm::distance(ReadRelief(made.view(), {10, 20}).point,
                                   ReadRelief(made.view(), {50, 24}).point);
  const ScalePart scale = ScaleFromLength(made.view(), {0.011, {10, 20}, {50, 24}});
  EXPECT_NEAR(scale.factor, 0.011 / now, 1e-12);
  // The radius and the relief together: the distance becomes the known one.
  const DepthMap relief = ScaledMap(made.relief, scale.factor);
  const ReliefView scaled{relief, made.sigma, made.origin, made.projection,
                          made.kRadius * scale.factor};
  EXPECT_NEAR(glm::distance(ReadRelief(scaled, {10, 20}).point, ReadRelief(scaled, {50, 24}).point),
              0.011, 1e-8)
      << "rounding of the relief's floats";
}

TEST(ReliefScale, CountsOnlyTheErrorAlongTheDistance) {
  test::SmallRelief made;
  made.sigma = DepthMap(made.kWidth, made.kHeight, 1e-3f);
  // On a sphere the ranges lie across the connection of two near points.
  const ScalePart across = ScaleFromLength(made.view(), {0.011, {10, 20}, {50, 20}});
  EXPECT_LT(across.sigma, 0.03);
  // A step of 9 mm between neighbours lies along the ranges: 1.4 mm of 9 mm.
  made.relief.at(31, 20) = 0.009f;
  const ScalePart along = ScaleFromLength(made.view(), {0.009, {30, 20}, {31, 20}});
  EXPECT_NEAR(along.sigma, 1.414 / 9, 0.01);
}

TEST(ReliefScale, RefusesNonsenseInASentence) {
  test::SmallRelief made;
  EXPECT_NE(Refusal(made.view(), {0, {10, 20}, {50, 20}}).find("does not fit into a joint"),
            std::string::npos);
  EXPECT_NE(Refusal(made.view(), {std::nan(""), {10, 20}, {50, 20}}).find("does not fit"),
            std::string::npos);
  EXPECT_NE(Refusal(made.view(), {0.5, {10, 20}, {50, 20}}).find("500 mm"), std::string::npos);
  EXPECT_NE(Refusal(made.view(), {0.01, {10, 20}, {10, 20}}).find("are the same"),
            std::string::npos);
  EXPECT_NE(Refusal(made.view(), {0.15, {10, 20}, {12, 20}}).find("by a factor of"),
            std::string::npos);
  EXPECT_NE(Refusal(made.view(), {0.01, {10, 20}, {90, 20}}).find("at the second point"),
            std::string::npos);
  made.origin.at(10, 20) = ReliefOrigin::kInterpolated;
  EXPECT_NE(Refusal(made.view(), {0.01, {10, 20}, {50, 20}}).find("at the first point"),
            std::string::npos);
  made.origin.at(10, 20) = ReliefOrigin::kMeasured;
  made.relief.at(11, 20) = 0.002f;
  made.sigma.at(11, 20) = 1e-3f;
  EXPECT_NE(Refusal(made.view(), {0.002, {10, 20}, {11, 20}}).find("too uncertain"),
            std::string::npos);
}

}  // namespace
}  // namespace arthro::authoring

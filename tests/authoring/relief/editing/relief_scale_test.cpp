#include "authoring/relief/editing/relief_scale.h"

#include <array>
#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/core/error.h"
#include "tests/authoring/relief/editing/small_relief.h"

namespace arthro::authoring {
namespace {

std::string Refusal(const ReliefView& view, const KnownDistance& known) {
  try {
    ScaleFromDistance(view, known);
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
  const ScaleFactor scale = ScaleFromDistance(made.view(), {{10, 20}, {50, 24}, 0.011});
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
  const ScaleFactor across = ScaleFromDistance(made.view(), {{10, 20}, {50, 20}, 0.011});
  EXPECT_LT(across.relative_sigma, 0.03);
  // A step of 9 mm between neighbours lies along the ranges: 1.4 mm of 9 mm.
  made.relief.at(31, 20) = 0.009f;
  const ScaleFactor along = ScaleFromDistance(made.view(), {{30, 20}, {31, 20}, 0.009});
  EXPECT_NEAR(along.relative_sigma, 1.414 / 9, 0.01);
}

TEST(ReliefScale, RefusesNonsenseInASentence) {
  test::SmallRelief made;
  EXPECT_NE(Refusal(made.view(), {{10, 20}, {50, 20}, 0}).find("does not fit into a joint"),
            std::string::npos);
  EXPECT_NE(Refusal(made.view(), {{10, 20}, {50, 20}, std::nan("")}).find("does not fit"),
            std::string::npos);
  EXPECT_NE(Refusal(made.view(), {{10, 20}, {50, 20}, 0.5}).find("500 mm"), std::string::npos);
  EXPECT_NE(Refusal(made.view(), {{10, 20}, {10, 20}, 0.01}).find("are the same"),
            std::string::npos);
  EXPECT_NE(Refusal(made.view(), {{10, 20}, {12, 20}, 0.15}).find("by a factor of"),
            std::string::npos);
  EXPECT_NE(Refusal(made.view(), {{10, 20}, {90, 20}, 0.01}).find("at the second point"),
            std::string::npos);
  made.origin.at(10, 20) = ReliefOrigin::kInterpolated;
  EXPECT_NE(Refusal(made.view(), {{10, 20}, {50, 20}, 0.01}).find("at the first point"),
            std::string::npos);
  made.origin.at(10, 20) = ReliefOrigin::kMeasured;
  made.relief.at(11, 20) = 0.002f;
  made.sigma.at(11, 20) = 1e-3f;
  EXPECT_NE(Refusal(made.view(), {{10, 20}, {11, 20}, 0.002}).find("too uncertain"),
            std::string::npos);
}

TEST(ReliefScale, JoinsTwoLengthsThatAgree) {
  EXPECT_EQ(JoinScales({}), 1);
  const std::array same{ScaleFactor{1.1, 0.01}, ScaleFactor{1.1, 0.05}};
  EXPECT_NEAR(JoinScales(same), 1.1, 1e-12);
  const std::array near{ScaleFactor{1.0, 0.01}, ScaleFactor{1.08, 0.02}};
  // A variance of a quarter has four times the weight.
  EXPECT_NEAR(JoinScales(near), std::exp(std::log(1.08) / 5), 1e-12);
}

TEST(ReliefScale, RefusesTwoLengthsThatDisagreeByMoreThanTenPercent) {
  const std::array inside{ScaleFactor{1.0, 0.01}, ScaleFactor{1.09, 0.01}};
  EXPECT_NO_THROW(JoinScales(inside));
  for (const auto& apart : {std::array{ScaleFactor{1.0, 0.01}, ScaleFactor{1.12, 0.01}},
                            std::array{ScaleFactor{1.12, 0.01}, ScaleFactor{1.0, 0.01}}})
    try {
      JoinScales(apart);
      ADD_FAILURE() << "12 % apart";
    } catch (const Error& error) {
      EXPECT_NE(error.sentence().find("disagree by 12 %"), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace arthro::authoring

// RELIEF-14. Several known lengths of one relief.
#include "authoring/relief/joined_scale.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "simulation/core/error.h"

namespace arthro::authoring {
namespace {

TEST(JoinScales, WeighsTheLogarithmsOfTheFactors) {
  const ScalePart sure{"length", 0.011, 2.0, 0.01}, unsure{"instrument", 0.004, 2.1, 0.02};
  const JoinedScale joined = JoinScales(std::vector{sure, unsure});
  // Weights 4 to 1.
  EXPECT_NEAR(joined.factor, std::exp((4 * std::log(2.0) + std::log(2.1)) / 5), 1e-12);
  EXPECT_NEAR(joined.sigma, 1 / std::sqrt(1 / 0.0001 + 1 / 0.0004), 1e-12);
}

TEST(JoinScales, RefusesLengthsThatDisagreeByMoreThanTenPercent) {
  const ScalePart a{"length", 0.011, 2.0, 0.01}, b{"instrument", 0.004, 2.25, 0.02};
  try {
    JoinScales(std::vector{a, b});
    FAIL() << "12 % apart";
  } catch (const Error& error) {
    EXPECT_NE(error.sentence().find("instrument of 4 mm and the length of 11 mm disagree by 12 %"),
              std::string::npos)
        << error.sentence();
  }
  EXPECT_NO_THROW(JoinScales(std::vector{a, ScalePart{"length", 0.02, 2.19, 0.01}}));
}

}  // namespace
}  // namespace arthro::authoring

#include "simulation/scene/medium.h"

#include <gtest/gtest.h>

namespace arthro {
namespace {

// 0.0255 is the textbook value of (0.38 / 2.38)^2.
TEST(Medium, TissueInGasMirrorsTwoAndAHalfPercent) {
  EXPECT_NEAR(NormalReflectance(kTissueIndex, kGasIndex), 0.0255, 5e-5);
  EXPECT_EQ(MirroredShare(Medium::kGas), 1.0);
}

TEST(Medium, SalineLeavesSeventyToNinetyTimesLessMirroredLight) {
  EXPECT_GE(1 / MirroredShare(Medium::kSaline), 70);
  EXPECT_LE(1 / MirroredShare(Medium::kSaline), 90);
}

}  // namespace
}  // namespace arthro

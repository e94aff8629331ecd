#include "app/editor/pictures/picture_rest.h"

#include <gtest/gtest.h>

namespace arthro::app {
namespace {

constexpr double kFrame = 1.0 / 30;

TEST(PictureRest, MovingPictureHasOneRayPerPixel) {
  PictureRest rest;
  for (int i = 0; i < 30; ++i) {
    EXPECT_EQ(rest.RaysDue(true, i * kFrame), 1);
    EXPECT_FALSE(rest.is_final());
  }
}

TEST(PictureRest, PictureAtRestIsDrawnOnceMoreAndThenNotAgain) {
  PictureRest rest;
  rest.RaysDue(true, 1.0);
  int drawn = 0;
  double final_at = 0;
  for (double t = 1.0 + kFrame; t < 3; t += kFrame) {
    const int rays = rest.RaysDue(false, t);
    if (rays == 0) continue;
    ++drawn;
    EXPECT_EQ(rays, 2);
    final_at = t;
  }
  EXPECT_EQ(drawn, 1);
  EXPECT_TRUE(rest.is_final());
  EXPECT_LT(final_at, 1.0 + PictureRest::kConverged);
}

TEST(PictureRest, ChangeAfterARestIsDrawnAtOnce) {
  PictureRest rest;
  rest.RaysDue(true, 0);
  rest.RaysDue(false, 1);
  ASSERT_TRUE(rest.is_final());
  EXPECT_EQ(rest.RaysDue(true, 1.01), 1);
  EXPECT_EQ(rest.RaysDue(false, 1.02), 0);
  EXPECT_FALSE(rest.is_final());
}

TEST(PictureRest, FirstPictureIsDrawnWithoutAChange) {
  PictureRest rest;
  EXPECT_EQ(rest.RaysDue(false, 5), 1);
}

}  // namespace
}  // namespace arthro::app

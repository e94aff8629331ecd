#include "app/view/settling.h"

#include <cmath>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace arthro::app {
namespace {

TEST(Settling, CycleOfTwoFramesIsNotDrawn) {
  glm::dvec3 drawn(0.0);
  for (int frame = 0; frame < 60; ++frame)
    Settle({frame % 2 == 0 ? 5e-6 : -5e-6, 0.01 * kStill, 0}, drawn);
  EXPECT_EQ(drawn, glm::dvec3(0.0));
}

TEST(Settling, MotionIsFollowedWithinSixFrames) {
  glm::dvec3 drawn(0.0);
  const glm::dvec3 now(2e-3, 0, 0);
  for (int frame = 0; frame < 6; ++frame) Settle(now, drawn);
  EXPECT_LT(glm::distance(drawn, now), kFollowed);
}

// The lag d of a place that moves by v per frame solves d³ / (d² + f²) = v.
TEST(Settling, SlowMotionLagsByLessThanAPixel) {
  for (const double speed : {1e-6, 5e-6, 20e-6}) {
    glm::dvec3 now(0.0), drawn(0.0);
    for (int frame = 0; frame < 300; ++frame) {
      now.x += speed;
      Settle(now, drawn);
      EXPECT_LT(glm::distance(drawn, now), kFollowed + speed);
    }
    EXPECT_GT(drawn.x, now.x - kFollowed - speed);
  }
}

TEST(Settling, NormalsFollowTheirPlacesAndStayUnit) {
  std::vector<glm::dvec3> drawn(2, glm::dvec3(0.0)), normals(2, glm::dvec3(0, 0, 1));
  const std::vector<glm::dvec3> now{{1e-6, 0, 0}, {1e-3, 0, 0}}, turned(2, glm::dvec3(1, 0, 0));
  Settle(now, turned, drawn, normals);
  EXPECT_EQ(normals[0], glm::dvec3(0, 0, 1));
  EXPECT_GT(normals[1].x, 0.9);
  EXPECT_NEAR(glm::length(normals[1]), 1.0, 1e-12);
}

}  // namespace
}  // namespace arthro::app

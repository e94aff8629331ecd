// Eye of the arthroscope: it stays outside of relief and tissues wherever the hand pushes the tip.
#include "simulation/practice/scope_eye.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <random>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/practice/session.h"
#include "simulation/scene/files/scene_io.h"
#include "tests/simulation/practice/hand.h"
#include "tests/support/build_paths.h"
#include "tests/support/shapes.h"

namespace arthro::simulation {
namespace {

constexpr double kRadius = 0.08;  // m, bare sphere of SceneOf
constexpr double kLens = ScopeEye::kLensRadius;

LoadedScene WithBlock(const glm::dvec3& low, const glm::dvec3& high) {
  Tissue tissue;
  tissue.name = "block";
  return SceneOf(test::Box(low, high), tissue);
}

TEST(ScopeEye, LeavesAFreeScopeWhereItIs) {
  ScopeEye eye(WithBlock({-0.01, -0.01, 0.04}, {0.01, 0.01, 0.05}));
  for (const RodPose& pose :
       {RodPose{0.1, -0.2, 3.0, 0.02}, RodPose{0, 0, 0, 0.03}, RodPose{0, 0, 0, -0.004}}) {
    const RodPose seen = eye.MoveTo(pose, TipInOwnPortal(pose));
    EXPECT_EQ(seen.latitude, pose.latitude);
    EXPECT_EQ(seen.longitude, pose.longitude);
    EXPECT_EQ(seen.roll, pose.roll);
    EXPECT_EQ(seen.depth, pose.depth);
  }
}

TEST(ScopeEye, StaysOffTheSphereAndATissueByTheLens) {
  const LoadedScene scene = WithBlock({-0.01, -0.01, 0.04}, {0.01, 0.01, 0.05});
  ScopeEye eye(scene);
  const RodPose aside{0.3, 0, 0, 0.09};
  EXPECT_NEAR(eye.MoveTo(aside, TipInOwnPortal(aside)).depth, kRadius - kLens, 1e-5);
  eye.Leave();
  const RodPose into{0, 0, 0, 0.045};
  const RodPose seen = eye.MoveTo(into, TipInOwnPortal(into));
  EXPECT_NEAR(seen.depth, 0.04 - kLens, 1e-5);
  EXPECT_NEAR(seen.latitude, 0, 1e-9);
}

TEST(ScopeEye, MovesSmoothlyIntoAWallAndOutOfIt) {
  ScopeEye eye(WithBlock({-0.01, -0.01, 0.04}, {0.01, 0.01, 0.05}));
  constexpr double kStep = 1e-4;  // m, per picture
  double last = 0.03;
  RodPose pose{0.02, 0.03, 0, last};
  eye.MoveTo(pose, TipInOwnPortal(pose));
  for (int i = 1; i <= 400; ++i) {
    pose.depth = 0.03 + kStep * (i <= 200 ? i : 400 - i);
    const RodPose seen = eye.MoveTo(pose, TipInOwnPortal(pose));
    ASSERT_LE(std::abs(seen.depth - last), 1.01 * kStep) << i;
    last = seen.depth;
  }
  EXPECT_EQ(last, pose.depth) << "it is free again";
}

TEST(ScopeEye, IsPushedBackByTissueThatMoves) {
  const LoadedScene scene = WithBlock({-0.01, -0.01, 0.04}, {0.01, 0.01, 0.05});
  ScopeEye eye(scene);
  const RodPose pose{0, 0, 0, 0.03};
  eye.MoveTo(pose, TipInOwnPortal(pose));
  WorldPicture world;
  auto skin = std::make_shared<BodySkin>();
  skin->surface = *scene.surfaces[0];
  world.bodies.resize(1);
  world.bodies[0].tissue = 0;
  world.bodies[0].skin = skin;
  // The front face moves from 40 mm to 25 mm from the portal, and back.
  for (int i = 0; i <= 60; ++i) {
    const double front = 0.04 - 0.015 * (1 - std::abs(i - 30) / 30.0);
    world.bodies[0].shape = static_cast<std::uint64_t>(i + 1);
    world.bodies[0].positions = skin->surface.vertices;
    for (glm::dvec3& x : world.bodies[0].positions)
      if (x.z < 0.045) x.z = front;
    eye.Follow(world);
    const RodPose seen = eye.MoveTo(pose, TipInOwnPortal(pose));
    EXPECT_LE(seen.depth, front - kLens + 1e-5) << i;
  }
  EXPECT_EQ(eye.MoveTo(pose, TipInOwnPortal(pose)).depth, pose.depth);
}

TEST(ScopeEye, IsNeverBelowTheReliefOfTheDemo) {
  const LoadedScene demo = LoadScene(std::filesystem::path(ARTHRO_SOURCE_DIR) / "resources/demo");
  const Backdrop& backdrop = demo.scene.backdrop;
  const DepthMap& relief = *demo.depth;
  // Reference: points of the map itself, not a surface over it.
  std::vector<glm::dvec3> points;
  for (int v = 0; v < relief.height; v += 4)
    for (int u = 0; u < relief.width; u += 4)
      if (const auto depth = static_cast<double>(relief.at(u, v)); std::isfinite(depth))
        points.push_back((backdrop.radius - depth) *
                         DirectionFromPixel(backdrop.projection, glm::dvec2(u, v)));
  ScopeEye eye(demo);
  std::mt19937_64 random(1);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  double nearest = std::numeric_limits<double>::infinity();
  int held = 0;
  for (int i = 0; i < 100; ++i) {
    const RodPose pose{uniform(-0.7, 0.7), uniform(-0.7, 0.7), 0, uniform(0.01, 0.045)};
    eye.Leave();
    eye.MoveTo(pose, TipInOwnPortal(pose));
    const glm::dvec3 x = eye.position();
    held += glm::distance(x, TipInOwnPortal(pose)) > 1e-4;
    for (const glm::dvec3& point : points) nearest = std::min(nearest, glm::distance(x, point));
    if (const auto pixel = PixelFromDirection(backdrop.projection, glm::normalize(x))) {
      const auto depth = static_cast<double>(
          relief.at(std::clamp(static_cast<int>(std::lround(pixel->x)), 0, relief.width - 1),
                    std::clamp(static_cast<int>(std::lround(pixel->y)), 0, relief.height - 1)));
      if (std::isfinite(depth)) {
        EXPECT_LT(glm::length(x), backdrop.radius - depth) << i;
      }
    }
  }
  std::printf("%d of 100 scopes held; nearest point of the relief %.2f mm from the eye\n", held,
              nearest * 1e3);
  EXPECT_GT(held, 20) << "the poses of this test do not reach the relief";
  // Points lie on the surface, or behind it where it takes the highest pixel around.
  EXPECT_GT(nearest, kLens - 1e-5);
}

}  // namespace
}  // namespace arthro::simulation

#include "simulation/tissue/contact/tool_shape.h"

#include <algorithm>
#include <array>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace arthro::simulation {
namespace {

struct Extent {
  glm::dvec3 low{1.0}, high{-1.0};
};

Extent ExtentOf(std::span<const Capsule> capsules) {
  Extent extent;
  for (const Capsule& capsule : capsules)
    for (const glm::dvec3& x : {capsule.a, capsule.b}) {
      extent.low = glm::min(extent.low, x - glm::dvec3(capsule.radius));
      extent.high = glm::max(extent.high, x + glm::dvec3(capsule.radius));
    }
  return extent;
}

TEST(ToolShape, SceneWordsNameTools) {
  EXPECT_EQ(ToolKindFromString("probe"), ToolKind::kProbe);
  EXPECT_EQ(ToolKindFromString("punch"), ToolKind::kPunch);
  EXPECT_EQ(ToolKindFromString("shaver"), ToolKind::kShaver);
  EXPECT_EQ(ToolKindFromString("grasper"), ToolKind::kGrasper);
  EXPECT_EQ(ToolKindFromString("spoon"), ToolKind::kProbe);
}

TEST(ToolShape, EveryToolEndsAtItsTip) {
  for (ToolKind kind :
       {ToolKind::kProbe, ToolKind::kPunch, ToolKind::kShaver, ToolKind::kGrasper}) {
    const ToolShape shape = ShapeOf(kind);
    EXPECT_EQ(shape.kind, kind);
    EXPECT_NEAR(ExtentOf(shape.capsules).high.z, 0.0, 1e-12) << static_cast<int>(kind);
    EXPECT_LE(static_cast<int>(shape.capsules.size()), kMaxCapsules);
    for (int jaw : shape.jaw) EXPECT_LT(jaw, static_cast<int>(shape.capsules.size()));
  }
  EXPECT_TRUE(ShapeOf(ToolKind::kNone).capsules.empty());
}

TEST(ToolShape, HasRealDimensions) {
  const ToolShape probe = ShapeOf(ToolKind::kProbe), punch = ShapeOf(ToolKind::kPunch),
                  shaver = ShapeOf(ToolKind::kShaver);
  const Capsule hook = probe.capsules[0];
  EXPECT_NEAR(hook.b.y - hook.a.y + 2 * hook.radius, 4e-3, 2e-4);
  EXPECT_NEAR(2 * probe.capsules[0].radius, 1.5e-3, 1e-12);
  const Extent jaws = ExtentOf(punch.capsules);
  EXPECT_NEAR(jaws.high.x - jaws.low.x, 3.4e-3, 1e-12);
  EXPECT_NEAR(2 * shaver.capsules[0].radius, 4.5e-3, 1e-12);
  EXPECT_GT(shaver.bite.b.y + shaver.bite.radius, shaver.capsules[0].radius)
      << "the window removes tissue that bulges into it";
}

TEST(ToolShape, JawOpensAwayFromTheFixedJaw) {
  for (ToolKind kind : {ToolKind::kPunch, ToolKind::kGrasper}) {
    const ToolShape shape = ShapeOf(kind);
    ToolInput input;
    input.is_present = true;
    input.portal_from_tool = {glm::angleAxis(0.7, glm::normalize(glm::dvec3(1, 2, 3))),
                              {0.01, 0.02, 0.03}};
    std::array<Capsule, kMaxCapsules> closed, open;
    ASSERT_EQ(PosedCapsules(shape, input, closed), static_cast<int>(shape.capsules.size()));
    input.opening = 1.0;
    PosedCapsules(shape, input, open);
    const glm::dvec3 y = input.portal_from_tool.rotation * glm::dvec3(0, 1, 0);
    for (std::size_t i = 0; i < shape.capsules.size(); ++i) {
      EXPECT_LT(glm::length(closed[i].b - input.portal_from_tool * shape.capsules[i].b), 1e-15);
      const bool is_jaw = std::ranges::count(shape.jaw, static_cast<int>(i)) > 0;
      EXPECT_EQ(glm::dot(open[i].b - closed[i].b, y) > 3e-3, is_jaw) << i;
      if (!is_jaw) {
        EXPECT_EQ(open[i].b, closed[i].b);
      }
    }
  }
}

TEST(ToolShape, AbsentToolHasNoCapsules) {
  std::array<Capsule, kMaxCapsules> capsules;
  EXPECT_EQ(PosedCapsules(ShapeOf(ToolKind::kProbe), {}, capsules), 0);
}

}  // namespace
}  // namespace arthro::simulation

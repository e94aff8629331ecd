#include "simulation/tissue/contact/obstacle_contact.h"

#include <algorithm>
#include <limits>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/simulation/tissue/contact/slab.h"
#include "tests/support/allocation_counter.h"

namespace arthro::simulation {
namespace {

// Ball of bone below the slab, in the portal frame; counts its queries.
struct Bone : RigidObstacle {
  double Gap(const glm::dvec3& x, glm::dvec3& normal) const noexcept override {
    ++asked;
    normal = glm::normalize(x - centre);
    return glm::length(x - centre) - radius;
  }
  glm::dvec3 centre{0.0};
  double radius = 0.02;
  mutable int asked = 0;
};

// Pose of the slab in the portal frame, and a bone that reaches `depth` into its underside.
const Rigid3 kPose{glm::angleAxis(0.8, glm::normalize(glm::dvec3(1, 2, 0.5))), {0.01, -0.02, 0.05}};
Bone BoneAt(double depth) {
  Bone bone;
  bone.centre = kPose * glm::dvec3(0, 0, test::kSlabLow.z - bone.radius + depth);
  return bone;
}

TEST(SurfaceNodes, AreTheNodesOfTheBoundary) {
  for (int order : {1, 2}) {
    const TetMesh mesh = test::SlabMesh(order, {4, 4, 4});
    std::vector<int> expected;
    for (std::size_t i = 0; i < mesh.rest_positions.size(); ++i)
      if (std::abs(test::BoxDistance(mesh.rest_positions[i])) < 1e-12)
        expected.push_back(static_cast<int>(i));
    EXPECT_EQ(SurfaceNodes(mesh), expected) << order;
  }
}

TEST(ObstacleContact, OverlapAtRestIsNotPushed) {
  const TetMesh mesh = test::SlabMesh(2, {10, 10, 3});
  ObstacleContact contact(mesh, {});
  const Bone bone = BoneAt(3e-4);
  contact.AcceptRestOverlap(bone, kPose, mesh.rest_positions);
  std::vector<ContactPoint> found;
  contact.Find(bone, kPose, mesh.rest_positions, {}, found);
  double deepest = 0.0;
  for (const ContactPoint& c : found)
    deepest = std::min(deepest, glm::dot(c.normal, c.start - c.foot));
  EXPECT_GT(deepest, -1e-12) << "no node is below the obstacle";
  // Pressed down by 0.1 mm, these nodes are that much deeper.
  found.clear();
  std::vector<glm::dvec3> pressed = mesh.rest_positions;
  for (glm::dvec3& x : pressed) x.z -= 1e-4;
  contact.Find(bone, kPose, pressed, {}, found);
  for (const ContactPoint& c : found)
    deepest = std::min(deepest, glm::dot(c.normal, c.start - c.foot));
  EXPECT_NEAR(deepest, -1e-4, 2e-6);
}

TEST(ObstacleContact, NodesInTheMarginAreKeptOutOfTheirHalfSpace) {
  const TetMesh mesh = test::SlabMesh(2, {10, 10, 3});
  ObstacleContact contact(mesh, {});
  const Bone bone = BoneAt(3e-4);
  std::vector<ContactPoint> found;
  ObstacleContactOptions options;
  contact.Find(bone, kPose, mesh.rest_positions, options, found);
  std::size_t expected = 0;
  for (int node : SurfaceNodes(mesh)) {
    glm::dvec3 normal;
    expected += bone.Gap(kPose * mesh.rest_positions[node], normal) < options.margin;
  }
  ASSERT_EQ(found.size(), expected);
  EXPECT_GT(expected, 20u);
  for (const ContactPoint& c : found) {
    const glm::dvec3& x = mesh.rest_positions[c.node[0]];
    glm::dvec3 normal;
    const double gap = bone.Gap(kPose * x, normal);
    EXPECT_NEAR(glm::dot(c.normal, x - c.foot), gap, 1e-15);
    EXPECT_LT(glm::length(kPose.rotation * c.normal - normal), 1e-12);
    EXPECT_EQ(c.owner, -1);
    EXPECT_EQ(c.start, x);
    EXPECT_EQ(c.stiffness, options.stiffness);
  }
}

TEST(ObstacleContact, FixedNodesAreNotTested) {
  const TetMesh mesh = test::SlabMesh(1);
  const std::vector<std::uint8_t> fixed(mesh.rest_positions.size(), 7);
  ObstacleContact contact(mesh, fixed);
  const Bone bone = BoneAt(1e-3);
  std::vector<ContactPoint> found;
  contact.Find(bone, kPose, mesh.rest_positions, {}, found);
  EXPECT_EQ(contact.watched_nodes(), 0);
  EXPECT_TRUE(found.empty());
  EXPECT_EQ(bone.asked, 0);
}

// The stiffness at a node scales with the remaining tissue. Otherwise nodes of removed tissue would
// have springs a hundred times stiffer than their elements.
TEST(ObstacleContact, StiffnessScalesWithTheRemainingShare) {
  const TetMesh mesh = test::SlabMesh(2, {4, 4, 4});
  std::vector<double> share(mesh.rest_positions.size(), 1.0);
  for (std::size_t i = 0; i < share.size(); ++i)
    if (mesh.rest_positions[i].x > 0) share[i] = 0.01;
  const Bone bone = BoneAt(0.0);
  std::vector<glm::dvec3> pressed = mesh.rest_positions;
  for (glm::dvec3& x : pressed) x.z -= 1e-4;
  ObstacleContact contact(mesh, {}, share);
  contact.AcceptRestOverlap(bone, kPose, mesh.rest_positions);
  std::vector<ContactPoint> found;
  const ObstacleContactOptions options;
  contact.Find(bone, kPose, pressed, options, found);
  ASSERT_GT(found.size(), 1u);
  for (const ContactPoint& c : found)
    EXPECT_EQ(c.stiffness, options.stiffness * share[static_cast<std::size_t>(c.node[0])]);
}

TEST(ObstacleContact, DistantNodesAreSkippedAndNoContactIsMissed) {
  const TetMesh mesh = test::SlabMesh(2, {10, 10, 3});
  ObstacleContact lazy(mesh, {});
  const Bone bone = BoneAt(0.0);
  std::vector<glm::dvec3> x = mesh.rest_positions;
  std::vector<ContactPoint> found, expected;
  found.reserve(mesh.rest_positions.size());
  lazy.Find(bone, kPose, x, {}, found);
  found.clear();
  const int first = bone.asked;
  const long before = test::Allocations();
  lazy.Find(bone, kPose, x, {}, found);
  EXPECT_EQ(test::Allocations(), before);
  EXPECT_LT(bone.asked - first, first / 5) << "at most a fifth of the nodes is near";
  // The slab sinks onto the bone; both must agree at every step.
  for (int step = 0; step < 30; ++step) {
    for (glm::dvec3& p : x) p.z -= 1e-4;
    ObstacleContact fresh(mesh, {});
    found.clear();
    expected.clear();
    lazy.Find(bone, kPose, x, {}, found);
    fresh.Find(bone, kPose, x, {}, expected);
    ASSERT_EQ(found.size(), expected.size()) << step;
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_EQ(found[i].foot, expected[i].foot);
  }
}

TEST(ObstacleContact, NonFiniteGapGivesNoContact) {
  struct Hole : RigidObstacle {
    double Gap(const glm::dvec3&, glm::dvec3&) const noexcept override {
      return std::numeric_limits<double>::quiet_NaN();
    }
  } hole;
  const TetMesh mesh = test::SlabMesh(1);
  ObstacleContact contact(mesh, {});
  std::vector<ContactPoint> found;
  contact.Find(hole, {}, mesh.rest_positions, {}, found);
  EXPECT_TRUE(found.empty());
}

}  // namespace
}  // namespace arthro::simulation

#include "simulation/haptics/surface/surface_bvh.h"

#include <algorithm>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/haptics/contact.h"
#include "tests/support/shapes.h"
#include "tests/support/ticks.h"

namespace arthro::simulation {
namespace {

using test::kTick;
constexpr double kSpring = 500.0;

ContactOptions Bare(double tip_radius = 0.0) {
  ContactOptions options;
  options.damping = options.static_friction = options.sliding_friction = 0.0;
  options.tip_radius = tip_radius;
  return options;
}

TEST(SurfaceBvh, BallMeetsAFaceAnEdgeAndACornerOfABox) {
  const SurfaceBvh box(test::Box(glm::dvec3(-0.01), glm::dvec3(0.01)), {});
  const double r = 0.002;
  SweepHit face, edge, corner;
  ASSERT_TRUE(box.Sweep({0.003, 0.001, 0.05}, {0.003, 0.001, -0.05}, r, -1, face));
  EXPECT_NEAR(face.fraction, (0.05 - 0.012) / 0.1, 1e-12);
  EXPECT_LT(glm::length(face.normal - glm::dvec3(0, 0, 1)), 1e-12);
  // Past the edge x = 10 mm by 1 mm: touched when the centre is √3 mm above the face.
  ASSERT_TRUE(box.Sweep({0.011, 0.001, 0.05}, {0.011, 0.001, -0.05}, r, -1, edge));
  EXPECT_NEAR(edge.fraction, (0.05 - 0.01 - std::sqrt(3.0) * 1e-3) / 0.1, 1e-12);
  EXPECT_LT(glm::length(edge.normal - glm::dvec3(0.5, 0, std::sqrt(0.75))), 1e-9);
  // Past the corner by 1 mm both ways: √2 mm.
  ASSERT_TRUE(box.Sweep({0.011, 0.011, 0.05}, {0.011, 0.011, -0.05}, r, -1, corner));
  EXPECT_NEAR(corner.fraction, (0.05 - 0.01 - std::sqrt(2.0) * 1e-3) / 0.1, 1e-12);
  SweepHit none;
  EXPECT_FALSE(box.Sweep({0.0121, 0, 0.05}, {0.0121, 0, -0.05}, r, -1, none));
  EXPECT_FALSE(box.Sweep({0, 0, 0}, {0, 0, 0.05}, r, -1, none)) << "what leaves is let pass";
}

// The hierarchy finds the same contacts as a test of every triangle.
TEST(SurfaceBvh, AgreesWithTryingEveryTriangle) {
  const SurfaceMesh ball = test::Sphere({0, 0, 0.03}, 0.01, 4);
  const SurfaceBvh tree(ball, {});
  std::vector<SurfaceBvh> single;
  for (const auto& triangle : ball.triangles) {
    SurfaceMesh one{ball.vertices, {triangle}};
    single.emplace_back(one, Pose{});
  }
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-0.02, 0.02);
  int met = 0;
  for (int trial = 0; trial < 1500; ++trial) {
    const glm::dvec3 from(any(random), any(random), 0.03 + any(random));
    const glm::dvec3 to(any(random), any(random), 0.03 + any(random));
    const double radius = trial % 3 * 1e-3;
    SweepHit fast, slow;
    tree.Sweep(from, to, radius, trial % 5 == 0 ? trial % 100 : -1, fast);
    for (const SurfaceBvh& one : single) one.Sweep(from, to, radius, -1, slow);
    ASSERT_EQ(fast.fraction, slow.fraction) << trial;
    met += fast.fraction < 1.0;
  }
  EXPECT_GT(met, 300);
}

// A long way excludes boxes by a different test than a short one.
TEST(SurfaceBvh, ALongWayMeetsWhatItsShortPiecesMeet) {
  const SurfaceBvh tree(test::Sphere({0, 0, 0.03}, 0.01, 4), {});
  constexpr double kPiece = 1e-3;  // m; triangles are 0.5 mm
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-0.02, 0.02);
  int met = 0;
  for (int trial = 0; trial < 6000; ++trial) {
    glm::dvec3 from(any(random), any(random), 0.03 + any(random));
    glm::dvec3 to(any(random), any(random), 0.03 + any(random));
    // Includes ways along an axis or in a plane of two, where projections have no width.
    if (trial % 4 == 1) to[trial % 3] = from[trial % 3];
    if (trial % 4 == 2) to = from, to[trial % 3] += 3.0 * any(random);
    const double radius = trial % 5 * 0.5e-3;
    SweepHit whole;
    tree.Sweep(from, to, radius, -1, whole);
    const int pieces = 1 + static_cast<int>(glm::length(to - from) / kPiece);
    SweepHit piece;
    int i = 0;
    for (; i < pieces && piece.fraction == 1.0; ++i)
      tree.Sweep(from + (to - from) * (1.0 * i / pieces), from + (to - from) * ((i + 1.0) / pieces),
                 radius, -1, piece);
    const double reference = piece.fraction < 1.0 ? (i - 1 + piece.fraction) / pieces : 1.0;
    ASSERT_NEAR(whole.fraction, reference, 1e-9) << trial;
    met += whole.fraction < 1.0;
  }
  EXPECT_GT(met, 1500);
}

TEST(SurfaceBvh, NoMeshBuildsNothing) {
  EXPECT_TRUE(SurfaceBvh(SurfaceMesh{}, {}).empty());
  SurfaceMesh flat;  // triangles without area
  flat.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  flat.triangles = {{0, 1, 2}, {1, 1, 2}};
  EXPECT_TRUE(SurfaceBvh(flat, {}).empty());
}

// Pose and scale place the mesh in the scene.
TEST(SurfaceBvh, PoseAndScaleAreApplied) {
  Pose pose;
  pose.position = {0, 0, 0.03};
  pose.scale = 2.0;
  const SurfaceBvh box(test::Box(glm::dvec3(-0.005), glm::dvec3(0.005)), pose);
  SweepHit hit;
  ASSERT_TRUE(box.Sweep({0, 0, 0}, {0, 0, 0.04}, 0, -1, hit));
  EXPECT_NEAR(hit.fraction, 0.5, 1e-12);
}

// F = K (R + r − |x − c|) outwards. The error is that of the facets.
TEST(MeshContact, BallPushesAlongItsRadius) {
  const glm::dvec3 centre(0.004, -0.002, 0.03);
  const double big = 0.008;
  const std::vector<SurfaceBvh> meshes{SurfaceBvh(test::Sphere(centre, big, 6), {})};
  EXPECT_EQ(meshes[0].triangle_count(), 32768u);
  for (double r : {0.0, 0.0005, 0.002}) {
    ContactState state;
    double worst_angle = 0, worst_force = 0;
    for (int i = 0; i < 3000; ++i) {
      const double t = i * kTick;
      const glm::dvec3 out =
          glm::normalize(glm::dvec3(0.6 * std::sin(2 * t), 0.5 * std::sin(3.1 * t), -1.0));
      const double depth = 1e-3 + 4e-4 * std::sin(9 * t);
      const glm::dvec3 tip = centre + (big + r - depth) * out;
      const ContactForce contact =
          TickContact({DepthField(), meshes}, Bare(r), kSpring, {}, tip, kTick, state);
      if (i < 100) continue;  // the tip comes from the portal, not along the radius
      ASSERT_EQ(contact.contact, 1);
      const glm::dvec3 reference = kSpring * depth * out;
      worst_force = std::max(worst_force, glm::length(contact.force) / glm::length(reference) - 1);
      worst_angle = std::max(
          worst_angle, std::acos(std::min(1.0, glm::dot(glm::normalize(contact.force), out))));
      ASSERT_LT(std::abs(glm::length(contact.force) - glm::length(reference)), 0.01 * 0.5);
    }
    std::printf(
        "ball of 32 768 facets, tip radius %.1f mm: force +%.2f %%, angle %.2f deg at worst\n",
        1e3 * r, 100 * worst_force, worst_angle * 57.2958);
    // Edges are up to 0.035 rad long; the middle of a facet is 0.035/√3 from its corners: 1.2°.
    EXPECT_LT(worst_angle, 1.2 / 57.2958);
  }
}

TEST(MeshContact, CornerOfARoomHoldsWithThreeFaces) {
  const glm::dvec3 half(0.01, 0.012, 0.014);
  const std::vector<SurfaceBvh> room{SurfaceBvh(test::InsideOut(test::Box(-half, half)), {})};
  const double r = 0.001;
  ContactState state;
  const glm::dvec3 depth(0.0005, 0.001, 0.0015);
  ContactForce contact;
  for (int i = 0; i < 200; ++i) {
    const glm::dvec3 tip = (half - r + depth) * std::min(1.0, i / 100.0);
    contact = TickContact({DepthField(), room}, Bare(r), kSpring, {}, tip, kTick, state);
  }
  // The skin is 1 µm: 0.5 mN per face.
  EXPECT_LT(glm::length(contact.force + kSpring * depth), 1e-3);
  EXPECT_LT(glm::length(state.proxy.position - (half - r)), 3e-6);
  EXPECT_NEAR(contact.penetration, glm::length(depth), 3e-6);
}

// Slides from the edge of a room along two faces, and leaves it.
TEST(MeshContact, SlidesAlongAnEdgeOfARoomAndLeavesIt) {
  const std::vector<SurfaceBvh> room{
      SurfaceBvh(test::InsideOut(test::Box(glm::dvec3(-0.01), glm::dvec3(0.01))), {})};
  ContactState state;
  for (int i = 0; i < 100; ++i)
    TickContact({DepthField(), room}, Bare(), kSpring, {}, glm::dvec3(0.011, 0.011, 0) * (i / 99.0),
                kTick, state);
  for (int i = 0; i <= 100; ++i) {
    const double z = 0.008 * i / 100;
    const ContactForce contact =
        TickContact({DepthField(), room}, Bare(), kSpring, {}, {0.011, 0.011, z}, kTick, state);
    EXPECT_NEAR(state.proxy.position.z, z, 1e-7);
    EXPECT_LT(glm::length(contact.force - glm::dvec3(-0.5, -0.5, 0)), 2e-3);
  }
  const ContactForce free =
      TickContact({DepthField(), room}, Bare(), kSpring, {}, {0.005, 0.005, 0.008}, kTick, state);
  EXPECT_EQ(free.contact, -1);
  EXPECT_EQ(free.force, glm::dvec3(0.0));
  EXPECT_LT(glm::length(state.proxy.position - glm::dvec3(0.005, 0.005, 0.008)), 1e-7);
}

// For random motions of the hand, the proxy stays outside a closed surface.
TEST(MeshContact, NothingTunnels) {
  const double size = 0.006;
  for (double r : {0.0, 0.001}) {
    const std::vector<SurfaceBvh> boxes{
        SurfaceBvh(test::Box(glm::dvec3(0, 0, 0.03) - size, glm::dvec3(0, 0, 0.03) + size), {}),
        SurfaceBvh(test::Sphere({0.012, 0, 0.03}, size, 3), {})};
    std::mt19937 random(11);
    std::uniform_real_distribution<double> any(-0.012, 0.012);
    ContactState state;
    glm::dvec3 tip(0, 0, 0.005), goal = tip;
    for (int i = 0; i < 40000; ++i) {
      if (i % 50 == 0)
        goal = glm::dvec3(0.006 + 1.5 * any(random), any(random), 0.03 + any(random));
      tip += 0.05 * (goal - tip);
      TickContact({DepthField(), boxes}, Bare(r), kSpring, {}, tip, kTick, state);
      const glm::dvec3 p = state.proxy.position - glm::dvec3(0, 0, 0.03);
      const double inside = size - std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
      ASSERT_LT(inside, 1e-9) << i;
    }
  }
}

}  // namespace
}  // namespace arthro::simulation

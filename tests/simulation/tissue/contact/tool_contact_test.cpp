// Capsules against a slab and a ball with closed-form answers.
#include "simulation/tissue/contact/tool_contact.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/core/process_cost.h"
#include "simulation/tissue/solver/contact_springs.h"
#include "tests/simulation/tissue/contact/slab.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/shapes.h"

namespace arthro::simulation {
namespace {

constexpr double kRadius = 0.75e-3;

// Mesh, skin, field and contact of one body; constructed in place because they refer to each other.
struct Body {
  Body(TetMesh of, SurfaceMesh surface, SolidField shape)
      : mesh(std::move(of)),
        finder(mesh),
        skin(EmbedSkin(std::move(surface), mesh, finder)),
        field(std::move(shape)),
        contact(skin, mesh, field, 5e5),
        positions(skin.point.size()),
        normals(skin.point.size()) {}
  Body(const Body&) = delete;
  void Move(const std::vector<glm::dvec3>& x) {
    DeformSkin(skin, mesh, x, positions, normals);
    contact.Refit(positions, normals, x);
  }
  std::vector<ContactPoint> Find(std::span<const Capsule> capsules, const glm::dvec3& motion = {},
                                 ToolGrip* grip = nullptr) const {
    std::vector<ContactPoint> contacts;
    contact.Find(capsules, motion, 0, options, contacts, grip);
    return contacts;
  }
  glm::dvec3 PlaceOf(const ContactPoint& contact_point, const std::vector<glm::dvec3>& x) const {
    glm::dvec3 place(0.0);
    for (int i = 0; i < contact_point.count; ++i)
      place += contact_point.weight[i] * x[contact_point.node[i]];
    return place;
  }
  // Gap of the tool at its commanded position.
  double Gap(const ContactPoint& c, const std::vector<glm::dvec3>& x) const {
    if (!c.is_round) return glm::dot(c.normal, PlaceOf(c, x) - c.foot);
    const glm::dvec3 way = c.b - c.a, from = PlaceOf(c, x) - c.a;
    const double length2 = glm::dot(way, way);
    const double along = length2 > 0 ? std::clamp(glm::dot(from, way) / length2, 0.0, 1.0) : 0.0;
    return glm::length(from - along * way) - c.radius;
  }
  double Gap(const ContactPoint& c) const { return Gap(c, mesh.rest_positions); }
  double LeastGap(const std::vector<ContactPoint>& contacts) const {
    double least = 1;
    for (const ContactPoint& c : contacts) least = std::min(least, Gap(c));
    return least;
  }
  // Force on a tool on its hand's spring if the tissue were rigid.
  glm::dvec3 HeldBy(const std::vector<ContactPoint>& contacts,
                    std::vector<ContactResult>& results) const {
    std::vector<glm::dvec3> pressing(contacts.size(), glm::dvec3(0.0));
    std::vector<ContactSpring> springs(contacts.size());
    std::vector<ToolHold> holds;
    FindHolds(contacts, holds);
    SetSprings(contacts, mesh.rest_positions, true, true, pressing, holds, springs);
    results.resize(contacts.size());
    for (std::size_t i = 0; i < contacts.size(); ++i)
      results[i] = {springs[i].point, springs[i].force, springs[i].gap, springs[i].push};
    glm::dvec3 force(0.0);
    for (const ContactSpring& spring : springs) force -= spring.force;
    return force;
  }

  TetMesh mesh;
  ElementFinder finder;
  EmbeddedSkin skin;
  SolidField field;
  SkinContact contact;
  ToolContactOptions options;
  std::vector<glm::dvec3> positions, normals;
};

Box3 Around(const glm::dvec3& low, const glm::dvec3& high) { return {low - 2e-3, high + 2e-3}; }

// Slab of 20 × 20 × 6 mm or thinner, its top at z = 0.
struct Slab : Body {
  explicit Slab(double thickness = 0.006)
      : Body(test::SlabMesh(2, {6, 6, 2}, Low(thickness), test::kSlabHigh),
             test::SlabSkin(5e-4, Low(thickness), test::kSlabHigh),
             SolidField::FromFunction(
                 Around(Low(thickness), test::kSlabHigh), 2.5e-4, [thickness](const glm::dvec3& x) {
                   return test::BoxDistance(x, Low(thickness), test::kSlabHigh);
                 })) {}
  static glm::dvec3 Low(double thickness) { return {-0.01, -0.01, -thickness}; }
};

struct Ball : Body {
  static constexpr double kBall = 0.008;
  Ball()
      : Body(test::SlabMesh(2, {4, 4, 4}, glm::dvec3(-0.009), glm::dvec3(0.009)),
             test::Sphere({0, 0, 0}, kBall, 5),
             SolidField::FromFunction(Around(glm::dvec3(-0.009), glm::dvec3(0.009)), 2.5e-4,
                                      [](const glm::dvec3& x) { return glm::length(x) - kBall; })) {
  }
};

// Largest depth to which a round end sinks between samples half its radius apart.
constexpr double kBetween = kRadius / 16;

TEST(SkinContact, ShaftOnAFlatTopHasUniformDepth) {
  const Slab slab;
  for (double depth : {-2e-4, 0.0, 1e-4, 5e-4}) {
    const Capsule shaft{
        {-0.004, 0.0003, kRadius - depth}, {0.004, 0.0003, kRadius - depth}, kRadius};
    const auto contacts = slab.Find(std::span(&shaft, 1));
    ASSERT_GT(contacts.size(), 20u);
    EXPECT_NEAR(slab.LeastGap(contacts), -depth, kBetween);
    EXPECT_GE(slab.LeastGap(contacts), -depth - 1e-12);
    double low = 1, high = -1;
    for (const ContactPoint& c : contacts) {
      EXPECT_LT(glm::length(c.normal - glm::dvec3(0, 0, -1)), 1e-12);
      EXPECT_EQ(c.owner, 0);
      EXPECT_EQ(c.count, 10);
      EXPECT_EQ(c.hold, 500.0);
      low = std::min(low, slab.PlaceOf(c, slab.mesh.rest_positions).x);
      high = std::max(high, slab.PlaceOf(c, slab.mesh.rest_positions).x);
    }
    EXPECT_GT(high - low, 0.0075) << "along its whole length";
  }
}

TEST(SkinContact, NoContactBeyondTheMargin) {
  const Slab slab;
  const Capsule shaft{{0, 0, 0.0018}, {0, 0, 0.01}, kRadius};
  EXPECT_TRUE(slab.Find(std::span(&shaft, 1)).empty());
  EXPECT_FALSE(slab.contact.IsNear(std::span(&shaft, 1), 1e-3));
  EXPECT_TRUE(slab.contact.IsNear(std::span(&shaft, 1), 1.1e-3));
}

// A jump of the hand watched all skin within 20 mm of its end, which took ten times as long as the
// rest of the step.
TEST(SkinContact, ToolThatJumpedWatchesTheSkinNearItOnly) {
  const Slab slab;
  ToolGrip grip;
  const Capsule near{{0, 0, 0.004}, {0, 0, 0.02}, kRadius},
      far{{0, 0, 0.009}, {0, 0, 0.02}, kRadius};
  EXPECT_FALSE(slab.Find(std::span(&near, 1), {0.01, 0, 0}, &grip).empty());
  grip = {};
  EXPECT_TRUE(slab.Find(std::span(&far, 1), {0.03, 0, 0}, &grip).empty());
}

TEST(SkinContact, TipTouchesWithItsEndOnly) {
  const Slab slab;
  const Capsule rod{{0.001, 0.002, kRadius - 2e-4}, {0.001, 0.002, 0.02}, kRadius};
  const auto contacts = slab.Find(std::span(&rod, 1));
  EXPECT_NEAR(slab.LeastGap(contacts), -2e-4, kBetween);
  for (const ContactPoint& c : contacts)
    if (slab.Gap(c) < 0) {
      EXPECT_LT(
          glm::distance(slab.PlaceOf(c, slab.mesh.rest_positions), glm::dvec3(0.001, 0.002, 0)),
          6e-4)
          << "√(2 r d)";
    }
}

TEST(SkinContact, DepthAndNormalOnABallAreWithinTheSampling) {
  const Ball ball;
  double gap_error = 0, angle = 0;
  for (int i = 0; i < 200; ++i) {
    const double u = 2.399963 * i, z = 1 - 2 * (i + 0.5) / 200;
    const glm::dvec3 out(std::sqrt(1 - z * z) * std::cos(u), std::sqrt(1 - z * z) * std::sin(u), z);
    const double depth = 3e-4;
    const glm::dvec3 end = (Ball::kBall + kRadius - depth) * out;
    const Capsule rod{end, end + 0.02 * out, kRadius};
    const auto contacts = ball.Find(std::span(&rod, 1));
    ASSERT_FALSE(contacts.empty()) << i;
    gap_error = std::max(gap_error, std::abs(ball.LeastGap(contacts) + depth));
    std::vector<ContactResult> results;
    const glm::dvec3 force = ball.HeldBy(contacts, results);
    angle = std::max(angle, std::asin(glm::length(glm::cross(glm::normalize(force), out))));
  }
  std::printf("rod on a ball: gap off by at most %.2e m, force by %.2f°\n", gap_error,
              angle * 57.2958);
  EXPECT_LT(gap_error, kBetween);
  // Half a sample's distance to the side of a ball of both radii.
  EXPECT_LT(angle, 0.25 * kRadius / (Ball::kBall + kRadius) * 2.0);
}

TEST(SkinContact, ShaftAcrossAnEdgeIsFound) {
  // Long edge of the slab across a shaft: the nearest point is on the edge itself.
  const Slab slab;
  double off = 0;
  for (double at = -0.002; at <= 0.002; at += 1.7e-4) {
    const double lift = kRadius * std::sqrt(0.5) - 5e-5;
    // Rod at 45° over the edge x = 10 mm, z = 0, shifted along itself.
    const glm::dvec3 across = glm::normalize(glm::dvec3(1, 0, -1)),
                     out = glm::normalize(glm::dvec3(1, 0, 1));
    const glm::dvec3 middle = glm::dvec3(0.01, 0, 0) + std::sqrt(2.0) * lift * out + at * across;
    const Capsule rod{middle - 0.004 * across, middle + 0.004 * across, kRadius};
    const double least = slab.LeastGap(slab.Find(std::span(&rod, 1)));
    off = std::max(off, std::abs(least + kRadius - std::sqrt(2.0) * lift));
  }
  std::printf("shaft over an edge: depth of 71 um, error at most %.2e m\n", off);
  // The nearest samples lie a third of a triangle's height off the edge.
  EXPECT_LT(off, 0.25 * kRadius / 3 + kBetween);
}

// FEM-09, geometric part: a tool that appears 5 mm deep is pushed out the shortest way.
TEST(SkinContact, Fem09JumpedToolFindsTheShortestWayOut) {
  const Slab slab(0.012);
  const Capsule rod{{0.001, 0.0003, -0.005}, {0.001, 0.0003, 0.02}, kRadius};
  const auto contacts = slab.Find(std::span(&rod, 1));
  ASSERT_FALSE(contacts.empty());
  double deepest = 0;
  for (const ContactPoint& c : contacts) {
    deepest = std::min(deepest, slab.Gap(c));
    EXPECT_TRUE(slab.Gap(c) > 0 || glm::length(c.normal - glm::dvec3(0, 0, -1)) < 1e-6);
  }
  EXPECT_NEAR(deepest, -0.005 - kRadius, 1e-5) << "within 1/25 of the grid spacing";
}

TEST(SkinContact, WayOutOfABentBodyFollowsTheDeformation) {
  Slab slab(0.012);
  std::vector<glm::dvec3> x = slab.mesh.rest_positions;
  for (glm::dvec3& p : x) p = {p.x + 0.4 * p.z, p.y, 0.7 * p.z};  // sheared and flattened
  slab.Move(x);
  const Capsule ball{{-0.0008, 0.0003, -0.0014}, {-0.0008, 0.0003, -0.0014}, kRadius};
  const auto contacts = slab.Find(std::span(&ball, 1));
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_LT(glm::length(contacts[0].normal - glm::dvec3(0, 0, -1)), 1e-6)
      << "this shear keeps the top level";
  EXPECT_NEAR(slab.Gap(contacts[0], x), -0.0014 - kRadius, 1e-5);
}

TEST(SkinContact, ToolThroughThinTissueIsPushedFromBothSidesAndFinite) {
  const Slab slab(0.0015);
  const Capsule rod{{0.001, 0.0003, -0.006}, {0.001, 0.0003, 0.02}, kRadius};
  for (const ContactPoint& c : slab.Find(std::span(&rod, 1))) {
    EXPECT_TRUE(std::isfinite(c.stiffness) && std::isfinite(c.foot.x + c.foot.y + c.foot.z));
    EXPECT_NEAR(glm::length(c.normal), 1.0, 1e-12);
    EXPECT_LE(std::abs(slab.Gap(c)), 0.0015 + kRadius);
  }
}

// The hand moves on into tissue thinner than F/k; the grip keeps its side.
TEST(SkinContact, HeldToolStaysOnItsSideOfThinTissue) {
  const Slab slab(0.0015);
  ToolGrip grip;
  glm::dvec3 motion(0.0);
  double z = 0.003;
  for (int step = 0; step < 6; ++step) {
    const Capsule rod{{0.001, 0.0003, z}, {0.001, 0.0003, z + 0.02}, kRadius};
    const auto contacts = slab.Find(std::span(&rod, 1), motion, &grip);
    std::vector<ContactResult> results;
    const glm::dvec3 force = slab.HeldBy(contacts, results);
    if (step > 1) {
      // In rigid tissue the whole compliance is that of the contact layer, under a round end.
      EXPECT_NEAR(force.z, 500.0 * (kRadius - z), 500.0 * 0.5 * kRadius) << step;
      EXPECT_LT(std::hypot(force.x, force.y), 0.02 * force.z) << step;
    }
    motion = {0, 0, -0.003};
    z -= 0.003;
    UpdateGrip(contacts, results, 0, slab.options, grip);
  }
  EXPECT_LT(z, -0.012) << "the hand is far beyond the tissue";
}

// A push that would carry the tool to where it does not touch the points that push it: 38 N of a
// probe that slipped off a meniscus, where the skin holds 5 N.
TEST(SkinContact, PushFromPointsThatTheToolHasLeftIsASlip) {
  const Slab slab(0.0015);
  const Capsule rod{{0.001, 0.0003, -0.004}, {0.001, 0.0003, 0.016}, kRadius};
  ToolGrip grip;
  grip.offset = {0, 0, 0.004 + kRadius}, grip.count = 1, grip.normal[0] = {0, 0, 1};
  const auto contacts = slab.Find(std::span(&rod, 1), glm::dvec3(0.0), &grip);
  std::vector<ContactResult> results;
  slab.HeldBy(contacts, results);
  const auto slipped = [&] {
    UpdateGrip(contacts, results, 0, slab.options, grip);
    return HasSlippedOff(std::span(&rod, 1), contacts, results, 0, grip);
  };
  EXPECT_FALSE(slipped()) << "held at the skin";
  for (ContactResult& result : results) result.force *= 20.0, result.push *= 20.0;
  EXPECT_TRUE(slipped());
  for (ContactResult& result : results) result.force = result.push = glm::dvec3(0.0);
  EXPECT_FALSE(slipped()) << "nothing pushes";
  EXPECT_FALSE(HasSlippedOff({}, {}, {}, 0, grip));
}

TEST(SkinContact, HeldToolSlidesAlongTheSkin) {
  const Slab slab;
  ToolGrip grip;
  const glm::dvec3 step(0.001, 0, 0);
  double low = 1e9, high = 0;
  for (int i = 0; i < 6; ++i) {
    const double x = -0.003 + 0.001 * i;
    const Capsule rod{{x, 0.0003, -0.003}, {x, 0.0003, 0.02}, kRadius};
    if (i == 0) grip.offset = {0, 0, 0.003 + kRadius}, grip.count = 1, grip.normal[0] = {0, 0, 1};
    const glm::dvec3 before = grip.offset;
    const auto contacts = slab.Find(std::span(&rod, 1), i == 0 ? glm::dvec3(0.0) : step, &grip);
    ASSERT_FALSE(contacts.empty());
    for (const ContactPoint& c : contacts) {
      EXPECT_NEAR(slab.PlaceOf(c, slab.mesh.rest_positions).x, x, kRadius + 3e-4 + 0.001 + 1e-9)
          << "around it, and as far again as it moved";
      if (i > 0) {
        EXPECT_LT(
            glm::length(c.start - (slab.PlaceOf(c, slab.mesh.rest_positions) + step - before)),
            1e-12)
            << "friction acts along the motion";
      }
    }
    std::vector<ContactResult> results;
    const double push = slab.HeldBy(contacts, results).z;
    UpdateGrip(contacts, results, 0, slab.options, grip);
    low = std::min(low, push);
    high = std::max(high, push);
  }
  EXPECT_LT(high - low, 500.0 * kBetween);
  EXPECT_NEAR(high, 500.0 * (0.003 + kRadius), 500.0 * 0.5 * kRadius);
}

// Forces must not flicker: a hook is drawn over a rigid ball in steps of 10 µm, pressed to 0.2 mm.
TEST(SkinContact, ForceIsSmoothAcrossSamples) {
  const Ball ball;
  std::array<Capsule, kMaxCapsules> capsules;
  ToolInput input;
  input.is_present = true;
  const ToolShape probe = ShapeOf(ToolKind::kProbe);
  ToolGrip grip;
  glm::dvec3 last(0.0);
  double largest = 0, force_level = 0;
  for (int i = 0; i < 600; ++i) {
    // The rod is level; the hook hangs down on the ball from +y, pressed from above.
    const double s = -0.003 + 1e-5 * i;
    const glm::dvec3 top(s, 0.0, Ball::kBall - 2e-4 - s * s / (2 * Ball::kBall));
    input.portal_from_tool = {glm::angleAxis(1.0, glm::dvec3(0, 1, 0)), top};
    const int count = PosedCapsules(probe, input, capsules);
    const auto contacts = ball.Find(std::span(capsules.data(), static_cast<std::size_t>(count)),
                                    i == 0 ? glm::dvec3(0.0) : glm::dvec3(1e-5, 0, 0), &grip);
    std::vector<ContactResult> results;
    const glm::dvec3 force = ball.HeldBy(contacts, results);
    UpdateGrip(contacts, results, 0, ball.options, grip);
    if (i > 20) largest = std::max(largest, glm::length(force - last));
    force_level = std::max(force_level, glm::length(force));
    last = force;
  }
  std::printf("hook over a ball: %.3f N, largest change in 10 um %.4f N\n", force_level, largest);
  // k times the step is 5 mN.
  EXPECT_LT(largest, 500.0 * 1e-5 + 0.04 * force_level);
}

TEST(SkinContact, LongShaftKeepsTheNearestContacts) {
  const Slab slab;
  const Capsule shaft{{-0.009, 0.0003, kRadius - 1e-4}, {0.05, 0.0003, kRadius - 1e-4}, kRadius};
  const auto contacts = slab.Find(std::span(&shaft, 1));
  EXPECT_EQ(contacts.size(), static_cast<std::size_t>(kMaxToolContacts));
  double low = 1, high = -1;
  for (const ContactPoint& c : contacts) {
    low = std::min(low, slab.PlaceOf(c, slab.mesh.rest_positions).x);
    high = std::max(high, slab.PlaceOf(c, slab.mesh.rest_positions).x);
  }
  EXPECT_GT(high - low, 0.018) << "spread over the 19 mm that touch";
}

TEST(SkinContact, PinchedTissueIsHeldFromBothSides) {
  // Closed jaws whose gap is the slab's edge: normals up and down.
  const Slab slab(0.0015);
  const std::array<Capsule, 2> jaws{
      Capsule{{0.004, 0, kRadius - 1e-4}, {0.012, 0, kRadius - 1e-4}, kRadius},
      Capsule{{0.004, 0, -0.0015 - kRadius + 1e-4}, {0.012, 0, -0.0015 - kRadius + 1e-4}, kRadius}};
  const auto contacts = slab.Find(jaws);
  std::vector<ContactResult> results;
  const glm::dvec3 force = slab.HeldBy(contacts, results);
  double up = 0, down = 0;
  for (const ContactResult& result : results)
    (result.push.z < 0 ? up : down) += std::abs(result.push.z);
  EXPECT_GT(up, 0.01);
  EXPECT_GT(down, 0.01);
  EXPECT_LT(std::abs(force.z), 0.05 * up) << "the forces cancel";
}

// FEM-16: a pose that is not finite touches nothing.
TEST(SkinContact, Fem16NonFinitePoseIsIgnored) {
  const Slab slab;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  ToolGrip grip;
  for (const Capsule& bad :
       {Capsule{{nan, 0, 0}, {0, 0, 0}, kRadius}, Capsule{{0, 0, 0}, {0, 0, 1e308}, nan},
        Capsule{{0, 0, 0}, {0, std::numeric_limits<double>::infinity(), 0}, kRadius}})
    EXPECT_TRUE(slab.Find(std::span(&bad, 1), {}, &grip).empty());
  const Capsule good{{0, 0, 0}, {0, 0, 0.01}, kRadius};
  for (const ContactPoint& c : slab.Find(std::span(&good, 1), {nan, 0, 0}, &grip))
    EXPECT_TRUE(std::isfinite(c.start.x));
}

TEST(SkinContact, FindIsRepeatableAndAllocatesNothing) {
  Slab slab;
  std::array<Capsule, kMaxCapsules> capsules;
  ToolInput input;
  input.is_present = true;
  input.portal_from_tool = {glm::angleAxis(3.0, glm::normalize(glm::dvec3(1, 0.2, 0))),
                            {0.001, 0, -0.0003}};
  const int count = PosedCapsules(ShapeOf(ToolKind::kProbe), input, capsules);
  const std::span<const Capsule> posed(capsules.data(), static_cast<std::size_t>(count));
  slab.Move(slab.mesh.rest_positions);
  std::vector<ContactPoint> first, second;
  first.reserve(kMaxToolContacts);
  second.reserve(kMaxToolContacts);
  ToolGrip grip, again;
  const long before = test::Allocations();
  double find = 1e9, refit = 1e9;
  for (int i = 0; i < 20; ++i) {
    first.clear();
    second.clear();
    double start = ThreadCpuMs();
    slab.contact.Find(posed, {}, 0, slab.options, first, &grip);
    find = std::min(find, ThreadCpuMs() - start);
    slab.contact.Find(posed, {}, 0, slab.options, second, &again);
    start = ThreadCpuMs();
    slab.contact.Refit(slab.positions, slab.normals, slab.mesh.rest_positions);
    refit = std::min(refit, ThreadCpuMs() - start);
  }
  EXPECT_EQ(test::Allocations(), before);
  ASSERT_EQ(first.size(), second.size());
  EXPECT_FALSE(first.empty());
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].start, second[i].start);
    EXPECT_EQ(first[i].stiffness, second[i].stiffness);
  }
  std::printf("probe on %zu triangles: find %.3f ms, refit %.3f ms\n",
              slab.skin.rest.triangles.size(), find, refit);
}

}  // namespace
}  // namespace arthro::simulation

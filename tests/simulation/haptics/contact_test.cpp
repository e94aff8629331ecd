// Contact with difficult surfaces: cliffs, holes, borders, silhouettes, wedges, friction. Hard
// cases: HAP in resources/doc/hard-cases.md.
#include "simulation/haptics/contact.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/support/allocation_counter.h"
#include "tests/support/haptics/analytic_relief.h"
#include "tests/support/shapes.h"
#include "tests/support/ticks.h"

namespace arthro::simulation {
namespace {

using test::AnalyticRelief;

using test::kTick;
constexpr double kStiffness = 500.0;
constexpr double kReliefPixel = 5e-5;  // m, of AnalyticRelief
constexpr float kHole = std::numeric_limits<float>::quiet_NaN();

AnalyticRelief Flat(double h = 0.004) {
  return AnalyticRelief::Make(ProjectionType::kGnomonic, [h](glm::dvec2) { return h; });
}

ContactOptions Bare() {
  ContactOptions options;
  options.damping = options.static_friction = options.sliding_friction = 0.0;
  return options;
}

// Leads a tip along a path and records its forces.
struct Felt {
  std::vector<ContactForce> contact;
  std::vector<glm::dvec3> proxy, tip;

  // The largest change of force in a tick, over what tip and proxy may have moved in it (K times).
  double LargestStep(std::size_t from = 1) const {
    double largest = 0;
    for (std::size_t i = std::max<std::size_t>(1, from); i < contact.size(); ++i)
      largest = std::max(largest, glm::length(contact[i].force - contact[i - 1].force));
    return largest;
  }
};

template <class Path>
Felt Lead(const Surroundings& around, const ContactOptions& options, int ticks, Path&& path,
          glm::dvec3 portal = {}) {
  Felt run;
  ContactState state;
  for (int i = 0; i < ticks; ++i) {
    run.tip.push_back(path(i));
    run.contact.push_back(
        TickContact(around, options, kStiffness, portal, run.tip.back(), kTick, state));
    run.proxy.push_back(state.proxy.position);
  }
  return run;
}

// HAP-09. The floor is at 49 mm; from x = 12.8 mm on it is 5 mm nearer, within one pixel.
class Cliff : public testing::TestWithParam<int> {};

TEST_P(Cliff, HardCase9NoPopThroughBelowTwoHundredMillimetresASecond) {
  const AnalyticRelief relief = AnalyticRelief::Make(
      ProjectionType::kGnomonic, [](glm::dvec2 p) { return p.x < 767.5 ? 0.001 : 0.006; });
  DepthFieldOptions smoothing;
  smoothing.smoothing_passes = smoothing.quantised_passes = GetParam();
  const DepthField field(relief.backdrop, relief.Float(), smoothing);
  const glm::dvec3 wall =
      glm::normalize(glm::dvec3(0.256, 0, 1.0));  // the cliff seen from the portal
  for (double speed : {0.02, 0.1, 0.199}) {
    // Moves along the floor at a depth of 0.5 mm, then 4 mm into the wall.
    const double way = 0.01;
    const int ticks = static_cast<int>(way / speed / kTick);
    const glm::dvec3 right = glm::normalize(glm::dvec3(wall.z, 0, -wall.x));
    const Felt run = Lead({field, {}}, Bare(), ticks, [&](int i) {
      return 0.0495 * wall + (-0.006 + way * i / ticks) * right;
    });
    double highest = 1;
    for (const glm::dvec3& proxy : run.proxy) highest = std::min(highest, glm::length(proxy));
    // The top of the cliff is at 44 mm; the smoothing rounds off less than half of its foot.
    EXPECT_GT(highest, 0.0465) << "the proxy climbed the cliff at " << speed << " m/s";
    // Held by the wall, the force is that of the depth in it, at most 4 mm, and that of the floor.
    EXPECT_LT(glm::length(run.contact.back().force), kStiffness * 0.0045);
    EXPECT_LT(run.contact.back().force.x, -kStiffness * 0.0025) << "the wall pushes back";
    // Per tick the force changes by at most the motion of tip and proxy: twice that of the tip, and
    // two pixels.
    EXPECT_LT(run.LargestStep(), kStiffness * (2 * speed * kTick + 2 * kReliefPixel));
  }
}

TEST_P(Cliff, HardCase9DownTheCliffTheForceFallsWithoutAKick) {
  const AnalyticRelief relief = AnalyticRelief::Make(
      ProjectionType::kGnomonic, [](glm::dvec2 p) { return p.x < 767.5 ? 0.006 : 0.001; });
  DepthFieldOptions smoothing;
  smoothing.smoothing_passes = smoothing.quantised_passes = GetParam();
  const DepthField field(relief.backdrop, relief.Float(), smoothing);
  const glm::dvec3 edge = glm::normalize(glm::dvec3(0.256, 0, 1.0));
  const glm::dvec3 right = glm::normalize(glm::dvec3(edge.z, 0, -edge.x));
  const double speed = 0.05;
  const Felt run = Lead({field, {}}, Bare(), 200, [&](int i) {
    return 0.0445 * edge + (-0.005 + speed * i * kTick) * right;
  });
  EXPECT_LT(run.LargestStep(), kStiffness * (2 * speed * kTick + 2 * kReliefPixel));
  EXPECT_EQ(run.contact.back().contact, -1) << "over the low ground the tip is free";
}

INSTANTIATE_TEST_SUITE_P(Smoothing, Cliff, testing::Values(0, 4, 24));

TEST(Contact, HardCase9HolesAndBordersFadeTheForce) {
  const AnalyticRelief relief = Flat();
  DepthMap map = relief.Float();
  for (int y = 0; y < map.height; ++y)
    for (int x = 500; x < 560; ++x) map.at(x, y) = kHole;
  map.at(300, 511) = kHole;  // a single bad pixel
  const DepthField field(relief.backdrop, map);
  // Moves from one border to the other over pixel and hole, at a depth of 1 mm and 60 mm/s.
  const Felt run = Lead({field, {}}, Bare(), 900, [&](int i) {
    return 0.047 * DirectionFromPixel(relief.backdrop.projection, {-20.0 + 1.2 * i, 511.0});
  });
  double strongest = 0;
  for (const ContactForce& contact : run.contact) {
    ASSERT_TRUE(std::isfinite(glm::length(contact.force)));
    strongest = std::max(strongest, glm::length(contact.force));
  }
  EXPECT_NEAR(strongest, 0.5, 0.01);
  const auto at_pixel = [&](double x) {
    return glm::length(run.contact[static_cast<std::size_t>((x + 20.0) / 1.2)].force);
  };
  EXPECT_EQ(at_pixel(-5), 0.0);
  EXPECT_EQ(at_pixel(530), 0.0) << "nothing is known in the hole";
  EXPECT_LT(at_pixel(300), 0.03) << "what is left of slipping off";
  EXPECT_NEAR(at_pixel(400), 0.5, 1e-3);
  EXPECT_NEAR(at_pixel(700), 0.5, 1e-3);
  // 1 mm fades over 8 pixels, crossed in 7 ticks: the steepest part of a smooth step is 1.5 / 7 of
  // 0.5 N.
  // For a tip from below, the proxy also climbs to the surface.
  EXPECT_LT(run.LargestStep(),
            0.5 * 1.5 / 7 + kStiffness * (2 * 1.2 * kReliefPixel + 2 * kReliefPixel));
}

// Moves off the top of a box of 2 mm down to the backdrop, at a depth of 0.5 mm below either
// surface, and back, which pushes the side of the box.
TEST(Contact, SweepAcrossASilhouetteHasNoStep) {
  const AnalyticRelief relief = Flat(0.0);
  const DepthField field(relief.backdrop, relief.Float());
  const std::vector<SurfaceBvh> meshes{
      SurfaceBvh(test::Box({-0.004, -0.004, 0.048}, {0.004, 0.004, 0.052}), {})};
  const auto along = [](double x) {
    const double s = std::clamp((x - 0.0035) / 0.002, 0.0, 1.0);
    const double down = s * s * (3 - 2 * s);
    const double backdrop = std::sqrt(0.0505 * 0.0505 - x * x);
    return glm::dvec3(x, 0.0003, (1 - down) * 0.0485 + down * backdrop);
  };
  for (bool is_back : {false, true})
    for (double speed : {0.01, 0.05, 0.15}) {
      const double way = 0.01;
      const int ticks = static_cast<int>(way / speed / kTick);
      const Felt run = Lead({field, meshes}, Bare(), ticks,
                            [&](int i) { return along(way * (is_back ? ticks - i : i) / ticks); });
      double peak = 0, fastest = 0;
      bool has[2] = {false, false};
      for (std::size_t i = 1; i < run.contact.size(); ++i) {
        peak = std::max(peak, glm::length(run.contact[i].force));
        fastest = std::max(fastest, glm::length(run.tip[i] - run.tip[i - 1]));
        if (run.contact[i].contact >= 0) has[run.contact[i].contact] = true;
      }
      EXPECT_TRUE(has[0] && has[1]);
      if (!is_back) {
        // At the edge, 0.5 mm beside the start of the descent, the tip is 0.79 mm below the top.
        EXPECT_NEAR(peak, kStiffness * (along(0.004).z - 0.048), 0.03) << "counted once";
      }
      const double bound = kStiffness * (2 * fastest + 2 * kReliefPixel);
      std::printf("silhouette %s at %3.0f mm/s: largest step %.4f N, bound %.4f N\n",
                  is_back ? "from the side" : "from the top", 1e3 * speed, run.LargestStep(),
                  bound);
      EXPECT_LT(run.LargestStep(), bound);
    }
}

// A tip pressed into the backdrop meets a box that lies on it, and stays in the wedge.
TEST(Contact, WedgeBetweenMeshAndBackdropHoldsTheTip) {
  const AnalyticRelief relief = Flat(0.0);
  const DepthField field(relief.backdrop, relief.Float());
  const std::vector<SurfaceBvh> meshes{
      SurfaceBvh(test::Box({0, -0.008, 0.048}, {0.008, 0.008, 0.052}), {})};
  const double speed = 0.02;
  const Felt run = Lead({field, meshes}, Bare(), 300,
                        [&](int i) { return glm::dvec3(-0.004 + speed * i * kTick, 0.0, 0.0503); });
  // 1.98 mm deep in the side of the box and 0.3 mm below the sphere: each adds its own force.
  const glm::dvec3 force = run.contact.back().force;
  EXPECT_NEAR(force.x, -kStiffness * (speed * 299 * kTick - 0.004), 0.005);
  EXPECT_NEAR(force.z, -kStiffness * 0.0003, 0.005);
  EXPECT_EQ(run.contact.back().contact, 1) << "the box carries most";
  EXPECT_EQ(run.contact[50].contact, 0);
  EXPECT_LT(run.LargestStep(), kStiffness * (2 * speed * kTick + 2 * kReliefPixel));
}

// HAP-08: another depth map, 3 mm nearer, while in contact.
TEST(Contact, HardCase8SwappedDepthMapDoesNotThrowTheProxy) {
  const AnalyticRelief low = Flat(0.004), high = Flat(0.007);
  const DepthField before(low.backdrop, low.Float()), after(high.backdrop, high.Float());
  ContactState state;
  const glm::dvec3 tip(0, 0, 0.047);
  TickContact({before, {}}, Bare(), kStiffness, {}, tip, kTick, state);
  glm::dvec3 last = state.proxy.position;
  for (int i = 0; i < 100; ++i) {
    TickContact({after, {}}, Bare(), kStiffness, {}, tip, kTick, state);
    ASSERT_LT(glm::length(state.proxy.position - last), 2 * kReliefPixel + 1e-7);
    last = state.proxy.position;
  }
  EXPECT_NEAR(last.z, 0.043, 1e-6) << "it has climbed to the new surface";
}

// HAP-23: a held tip that trembles within the friction cone.
TEST(Contact, HardCase23FrictionHoldsWithoutDrift) {
  const AnalyticRelief relief = AnalyticRelief::Waves(ProjectionType::kGnomonic);
  const DepthField field(relief.backdrop, relief.Float());
  ContactOptions options;
  options.static_friction = 0.3;
  options.sliding_friction = 0.2;
  const glm::dvec2 p(611.5, 470.5);
  const glm::dvec3 n = relief.Normal(p), foot = relief.Surface(p);
  const glm::dvec3 along = glm::normalize(glm::cross(n, glm::dvec3(1, 0, 0)));
  ContactState state;
  const auto tick = [&](const glm::dvec3& tip) {
    return TickContact({field, {}}, options, kStiffness, {}, tip, kTick, state);
  };
  const auto tremble = [&](int i) {
    tick(foot - (1e-3 + 1e-4 * std::sin(0.05 * i)) * n + 1e-4 * std::sin(0.03 * i) * along);
  };
  for (int i = 0; i < 2000; ++i) tremble(i);  // settles under the tremor
  const glm::dvec3 held = state.proxy.position;
  for (int i = 2000; i < 62000; ++i) tremble(i);  // 60 s
  EXPECT_LT(glm::length(state.proxy.position - held), 1e-5);
}

// HAP-23, the other half: 0.1 mm/s for 60 s.
TEST(Contact, HardCase23SlowStrokeStaysWithinTheFrictionCone) {
  const AnalyticRelief relief = Flat(0.004);
  const DepthField field(relief.backdrop, relief.Float());
  ContactOptions options;
  options.damping = 0.0;
  ContactState state;
  double along_peak = 0, largest_step = 0;
  glm::dvec3 last(0.0);
  for (int i = 0; i < 60000; ++i) {
    const double angle = 1e-4 * i * kTick / 0.047;
    const glm::dvec3 out(std::sin(angle), 0, std::cos(angle));
    const ContactForce contact =
        TickContact({field, {}}, options, kStiffness, {}, 0.047 * out, kTick, state);
    const double normal = -glm::dot(contact.force, out);
    const double along = glm::length(contact.force + normal * out);
    ASSERT_NEAR(normal, 0.5, 2e-3);
    along_peak = std::max(along_peak, along / normal);
    if (i > 0) largest_step = std::max(largest_step, glm::length(contact.force - last));
    last = contact.force;
  }
  EXPECT_LE(along_peak, options.static_friction * 1.001);
  EXPECT_GT(along_peak, options.static_friction * 0.9);
  // From stick to slip the force falls by (µs − µd) F.
  EXPECT_LT(largest_step, (options.static_friction - options.sliding_friction) * 0.5 * 1.2);
}

TEST(Contact, ViscosityResistsApproachOnlyAndNeverPulls) {
  const AnalyticRelief relief = Flat(0.004);
  const DepthField field(relief.backdrop, relief.Float());
  ContactOptions with, without;
  without.damping = 0.0;
  const auto path = [](int i) { return glm::dvec3(0, 0, 0.046 + 1e-3 * std::sin(0.05 * i)); };
  const Felt damped = Lead({field, {}}, with, 500, path),
             bare = Lead({field, {}}, without, 500, path);
  double most = 0;
  for (std::size_t i = 1; i < 500; ++i) {
    const double extra = -(damped.contact[i].force.z - bare.contact[i].force.z);
    EXPECT_GE(extra, -1e-12);
    if (damped.tip[i].z < damped.tip[i - 1].z - 1e-5) {
      EXPECT_LT(extra, 0.02) << "leaving; the filter's tail";
    }
    EXPECT_LE(damped.contact[i].force.z, 0.0) << "a surface pushes";
    most = std::max(most, extra);
  }
  EXPECT_NEAR(most, 0.05, 0.01) << "b·v = 1 Ns/m · 50 mm/s";
}

// HAP-10: an 8-bit staircase stroked at 20 mm/s.
TEST(Contact, HardCase10EightBitStaircaseDoesNotBuzz) {
  const AnalyticRelief ramp = AnalyticRelief::Make(
      ProjectionType::kGnomonic, [](glm::dvec2 p) { return 0.003 + 2e-6 * (p.x - 511.5); });
  const DepthField field(ramp.backdrop, ramp.EightBit());
  constexpr int kTicks = 1000;
  const Felt run = Lead({field, {}}, Bare(), kTicks + 100, [&](int i) {
    const glm::dvec2 p(311.5 + 0.4 * i, 511.5);
    return ramp.Surface(p) - 1e-3 * ramp.Normal(p);
  });
  double dc = 0, above = 0;
  for (int k = 0; k <= kTicks / 2; ++k) {
    std::complex<double> sum = 0;
    for (int i = 0; i < kTicks; ++i)
      sum += glm::length(run.contact[static_cast<std::size_t>(100 + i)].force) *
             std::polar(1.0, -2 * std::numbers::pi * k * i / kTicks);
    if (k == 0) dc = std::abs(sum) / kTicks;
    if (k > 100) above += 2 * std::norm(sum / static_cast<double>(kTicks));
  }
  std::printf("8-bit staircase: %.4f %% of DC above 100 Hz\n", 100 * std::sqrt(above / 2) / dc);
  EXPECT_LT(std::sqrt(above / 2), 0.05 * dc);
}

// Plate of 2 mm. The tip moves past its edge, below it and back through the plate.
Felt DrawnThroughAPlate(double from_z, double to_z, int still) {
  const DepthField nothing;
  const std::vector<SurfaceBvh> meshes{
      SurfaceBvh(test::Box({-0.01, -0.01, 0.040}, {0.01, 0.01, 0.042}), {})};
  const double step = 5e-5;  // m in a tick: 50 mm/s
  std::vector<glm::dvec3> path{{0.014, 0, 0.02}};
  const auto lead = [&](const glm::dvec3& to) {
    const glm::dvec3 from = path.back();
    const int ticks = static_cast<int>(std::ceil(glm::distance(from, to) / step));
    for (int i = 1; i <= ticks; ++i) path.push_back(glm::mix(from, to, 1.0 * i / ticks));
  };
  lead({0.014, 0, from_z});
  lead({0, 0, from_z});
  lead({0, 0, to_z});
  for (int i = 0; i < still; ++i) path.push_back(path.back());
  return Lead({nothing, meshes}, Bare(), static_cast<int>(path.size()),
              [&](int i) { return path[static_cast<std::size_t>(i)]; });
}

TEST(Contact, AProxyCaughtBehindAnEdgeIsReleasedWhereTheRodIsFree) {
  const Felt run = DrawnThroughAPlate(0.045, 0.020, 0);
  double furthest = 0, largest_fall = 0;
  for (std::size_t i = 1; i < run.contact.size(); ++i) {
    furthest = std::max(furthest, glm::distance(run.proxy[i], run.tip[i]));
    largest_fall = std::max(
        largest_fall, glm::length(run.contact[i - 1].force) - glm::length(run.contact[i].force));
  }
  std::printf("caught: %.1f mm at most, the force falls by %.3f N in a tick\n", 1e3 * furthest,
              largest_fall);
  EXPECT_GT(furthest, 8e-3) << "else it was not caught";
  // 8 mm, and the path in 0.15 s at 50 mm/s.
  EXPECT_LT(furthest, 8e-3 + 7.5e-3 + 1e-4);
  EXPECT_LT(largest_fall, 0.2);
  EXPECT_EQ(run.contact.back().force, glm::dvec3(0.0));
  EXPECT_EQ(run.proxy.back(), run.tip.back());
}

TEST(Contact, AToolThatHooksBehindAnEdgeIsHeld) {
  const Felt run = DrawnThroughAPlate(0.045, 0.0355, 2000);  // 6.5 mm above its underside
  EXPECT_NEAR(run.contact.back().force.z, kStiffness * 0.0065, 0.01);
}

// Drawn 15 mm up, but below a second plate, which no rod can cross.
TEST(Contact, AProxyIsNotReleasedThroughASurface) {
  const DepthField nothing;
  const std::vector<SurfaceBvh> meshes{
      SurfaceBvh(test::Box({-0.01, -0.01, 0.040}, {0.01, 0.01, 0.042}), {}),
      SurfaceBvh(test::Box({-0.01, -0.01, 0.015}, {0.01, 0.01, 0.016}), {})};
  const Felt run = Lead({nothing, meshes}, Bare(), 3000, [](int i) {
    if (i < 100) return glm::dvec3(0.02, 0, 0.045);
    if (i < 200) return glm::dvec3(2e-4 * (200 - i), 0, 0.045);
    return glm::dvec3(0, 0, 0.045 - 0.018 * std::min(1.0, (i - 200) / 500.0));
  });
  EXPECT_NEAR(run.contact.back().force.z, kStiffness * 0.015, 0.01);
}

TEST(Contact, EmptySurroundingsAreFree) {
  ContactState state;
  const DepthField nothing;
  for (int i = 0; i < 100; ++i) {
    const glm::dvec3 tip(0, 0, 1e-3 * i);
    const ContactForce contact =
        TickContact({nothing, {}}, ContactOptions{}, kStiffness, {}, tip, kTick, state);
    EXPECT_EQ(contact.force, glm::dvec3(0.0));
    EXPECT_EQ(contact.contact, -1);
    EXPECT_EQ(state.proxy.position, tip);
  }
}

// Hands that jump, tremble and leave the workspace: the force is finite and at most K times the
// distance.
TEST(Contact, WildHandsStayFinite) {
  const AnalyticRelief relief = AnalyticRelief::Waves(ProjectionType::kEquirectangular);
  DepthMap map = relief.EightBit();
  for (int y = 300; y < 340; ++y)
    for (int x = 300; x < 420; ++x) map.at(x, y) = kHole;
  const DepthField field(relief.backdrop, map);
  const std::vector<SurfaceBvh> meshes{SurfaceBvh(test::Sphere({0, 0, 0.045}, 0.006, 3), {})};
  for (double r : {0.0, 0.002}) {
    ContactOptions options;
    options.tip_radius = r;
    ContactState state;
    unsigned random = 12345;
    const auto any = [&] {
      random = random * 1664525u + 1013904223u;
      return static_cast<double>(random >> 8) / (1 << 24) - 0.5;
    };
    glm::dvec3 tip(0, 0, 0.03);
    for (int i = 0; i < 20000; ++i) {
      tip += 2e-3 * glm::dvec3(any(), any(), any());
      if (i % 1000 == 0) tip = glm::dvec3(0.1 * any(), 0.1 * any(), 0.15 * any());
      const ContactForce contact =
          TickContact({field, meshes}, options, kStiffness, {}, tip, kTick, state);
      ASSERT_TRUE(std::isfinite(contact.force.x + contact.force.y + contact.force.z)) << i;
      ASSERT_TRUE(std::isfinite(state.proxy.position.x)) << i;
      ASSERT_LE(contact.penetration, 0.3) << i;
    }
  }
}

TEST(Contact, AllocatesNothing) {
  const AnalyticRelief relief = AnalyticRelief::Waves(ProjectionType::kGnomonic);
  const DepthField field(relief.backdrop, relief.Float());
  const std::vector<SurfaceBvh> meshes{SurfaceBvh(test::Sphere({0, 0, 0.045}, 0.006, 5), {})};
  ContactState state;
  const long before = test::Allocations();
  for (int i = 0; i < 3000; ++i) {
    const glm::dvec3 tip(0.01 * std::sin(0.003 * i), 0.01 * std::sin(0.002 * i), 0.047);
    TickContact({field, meshes}, ContactOptions{}, kStiffness, {}, tip, kTick, state);
    field.Query(tip);
  }
  EXPECT_EQ(test::Allocations(), before);
  EXPECT_GT(test::Allocations(), 0) << "the counter counts";
}

}  // namespace
}  // namespace arthro::simulation

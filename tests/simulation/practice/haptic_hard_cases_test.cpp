// Hard cases HAP of resources/doc/hard-cases.md through the whole path from a sample to a force:
// session, contact, lever, output chain, and a simulated device with a hand where the hand is
// pushed. Unit tests of the parts are beside the parts.
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdio>
#include <limits>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/device/plant_device.h"
#include "simulation/practice/replay/replay.h"
#include "simulation/practice/servo_loop.h"
#include "tests/simulation/practice/hand.h"
#include "tests/support/haptics/analytic_relief.h"

namespace arthro::simulation {
namespace {

using test::AnalyticRelief;

constexpr double kPixel = 5e-5;             // m, of AnalyticRelief
constexpr double kFrictionOfDevice = 0.26;  // N, of a plant

LoadedScene SceneOver(const AnalyticRelief& relief, DepthMap depth) {
  LoadedScene loaded;
  loaded.scene.backdrop = relief.backdrop;
  loaded.panorama = Share(ColourImage(relief.width, relief.height));
  loaded.depth = Share(std::move(depth));
  return loaded;
}

AnalyticRelief Flat(double h = 0.004) {
  return AnalyticRelief::Make(ProjectionType::kGnomonic, [h](glm::dvec2) { return h; });
}

RodPose PoseAt(const glm::dvec3& tip) {
  RodPose pose;
  pose.depth = glm::length(tip);
  pose.latitude = -std::asin(tip.y / pose.depth);
  pose.longitude = std::atan2(tip.x, tip.z);
  return pose;
}

// Simulated device of the scope, armed and ramped; its hand is led by an intended position of the
// tip.
struct Held {
  Held(const LoadedScene& loaded, const glm::dvec3& tip, const PlantOptions& plant,
       const HandModel& hand, const SessionOptions& options = {})
      : session(loaded, options), scope(plant, hand, HipOf(tip)), loop(session, &scope, nullptr) {
    ServoRequest request{session.options(), 0, 0, {}, {}, ToolKind::kProbe, {false, false}};
    loop.SetRequest(request);
    for (int i = 0; i < 10; ++i) Tick(tip);
    request.is_dead_man_held = {true, true};
    loop.SetRequest(request);
    for (int i = 0; i < 1000; ++i) Tick(tip);
  }
  glm::dvec3 HipOf(const glm::dvec3& tip) const {
    return HipFromRodPose(PoseAt(tip), session.scope_rig());
  }
  const ToolState& Tick(const glm::dvec3& tip) {
    scope.plant().SetIntent(HipOf(tip));
    loop.TickOnce(now += kTick);
    return loop.ReadSnapshot().scope;
  }
  Session session;
  PlantDevice scope;
  ServoLoop loop;
  double now = 0;
};

// Checks that every increase of a force is within the rise of the limiter.
void ExpectWithinRise(const glm::dvec3& force, const glm::dvec3& last,
                      const LimiterOptions& limiter) {
  ASSERT_TRUE(std::isfinite(glm::length(force)));
  ASSERT_LE(glm::length(force), limiter.max_force + 1e-12);
  ASSERT_LE(glm::length(force) - glm::length(last), limiter.max_rise * kTick + 1e-9);
}

// Changes the depth map under a stroking tip: nearer, further, a slope, a hole, 8 bits.
class HardCase8 : public testing::TestWithParam<int> {};
TEST_P(HardCase8, ASwappedDepthMapGivesNoForceJump) {
  const AnalyticRelief low = Flat(0.004);
  AnalyticRelief other =
      GetParam() == 0   ? Flat(0.007)
      : GetParam() == 1 ? Flat(0.001)
      : GetParam() == 2
          ? AnalyticRelief::Make(ProjectionType::kGnomonic,
                                 [](glm::dvec2 p) { return 0.004 + 4e-5 * (p.x - 511.5); })
          : AnalyticRelief::Waves(ProjectionType::kGnomonic);
  DepthMap map = GetParam() == 4 ? other.EightBit() : other.Float();
  if (GetParam() == 3)
    for (int y = 480; y < 540; ++y)
      for (int x = 480; x < 540; ++x) map.at(x, y) = std::numeric_limits<float>::quiet_NaN();
  const DepthField before(low.backdrop, low.Float()), after(other.backdrop, map);

  const SessionOptions options;
  ContactState contact;
  OutputState output;
  glm::dvec3 proxy(0.0), last(0.0);
  double largest = 0;
  for (int i = 0; i < 3000; ++i) {
    const bool is_swapped = i / 300 % 2 == 1;  // alternates
    const double x = 2e-3 * std::sin(2e-3 * i);
    const glm::dvec3 tip(x, 0, 0.047), hand(0.0, 0.0, -0.153);
    const Lever lever = LeverAt(hand, 0.2, options.lever);
    const ContactForce felt = TickContact({is_swapped ? after : before, {}}, options.contact,
                                          options.contact.stiffness, {}, tip, kTick, contact);
    if (i > 0) {
      ASSERT_LE(glm::length(contact.proxy.position - proxy), 2 * kPixel + 4e-6 + 1e-7) << i;
    }
    proxy = contact.proxy.position;
    TipForce to_hand{felt.force, options.contact.stiffness, lever, hand, 4e-3};
    const LimitedForce sent =
        ForceToHand({options.passivity, options.thermal, options.limiter}, to_hand, kTick, output);
    ExpectWithinRise(sent.force, last, options.limiter);
    if (HasFatalFailure()) return;
    largest = std::max(largest, glm::length(sent.force - last));
    last = sent.force;
  }
  std::printf("swap %d: largest step of the force %.3f N in a tick\n", GetParam(), largest);
}
INSTANTIATE_TEST_SUITE_P(Maps, HardCase8, testing::Values(0, 1, 2, 3, 4));

// Leads a held device over a cliff of 5 mm in one pixel, a bad pixel, a hole, and off the picture.
TEST(HardCase9, AHeldDeviceOverCliffHoleBadPixelAndBorderIsNeverKicked) {
  AnalyticRelief relief = AnalyticRelief::Make(
      ProjectionType::kGnomonic, [](glm::dvec2 p) { return p.x < 611.5 ? 0.001 : 0.006; });
  DepthMap map = relief.Float();
  const float hole = std::numeric_limits<float>::quiet_NaN();
  for (int y = 0; y < map.height; ++y)
    for (int x = 300; x < 340; ++x) map.at(x, y) = hole;
  map.at(420, 511) = hole;
  for (const HandModel& hand : {kSoftHand, kHand, kStiffHand, kWholeArm})
    for (const double speed : {0.02, 0.1, 0.199}) {
      // At the foot of the cliff the tip would have to climb 5 mm; it penetrates by 3 mm.
      const auto tip_at = [&](double x_px) {
        const double depth = 0.0495;
        return depth * DirectionFromPixel(relief.backdrop.projection, {x_px, 511.0});
      };
      const double from = -40, to = 670;  // px, from off the picture
      Held held(SceneOver(relief, map), tip_at(from), {}, hand);
      const int ticks = static_cast<int>((to - from) * kPixel / speed / kTick);
      glm::dvec3 last = held.scope.force();
      double strongest = 0, nearest = 1;
      for (int i = 0; i < ticks; ++i) {
        const ToolState& tool = held.Tick(tip_at(from + (to - from) * i / ticks));
        ASSERT_EQ(tool.fault, Fault::kNone) << i;
        ExpectWithinRise(held.scope.force(), last, held.session.options().limiter);
        if (HasFatalFailure()) return;
        last = held.scope.force();
        strongest = std::max(strongest, glm::length(last));
        nearest = std::min(nearest, glm::length(tool.proxy_in_portal));
      }
      EXPECT_GT(strongest, 0.05) << "else nothing was touched";
      EXPECT_GT(nearest, 0.0465) << "it did not pop through to the top of the cliff, at 44 mm";
    }
}

// A stiff hand strokes an 8-bit ramp at 20 mm/s. The encoder is fine, so that vibration comes from
// the staircase alone.
TEST(HardCase10, AnEightBitStaircaseDoesNotBuzzInTheHand) {
  const AnalyticRelief ramp = AnalyticRelief::Make(
      ProjectionType::kGnomonic, [](glm::dvec2 p) { return 0.003 + 2e-6 * (p.x - 511.5); });
  PlantOptions plant;
  plant.quantum = plant.friction = 0;
  const auto tip_at = [&](int i) {
    const glm::dvec2 p(311.5 + 0.4 * i, 511.5);
    return ramp.Surface(p) - 1e-3 * ramp.Normal(p);
  };
  Held held(SceneOver(ramp, ramp.EightBit()), tip_at(0), plant, kStiffHand);
  constexpr int kTicks = 1000;
  std::vector<double> force;
  for (int i = 0; i < kTicks + 100; ++i) {
    held.Tick(tip_at(i));
    if (i >= 100) force.push_back(glm::length(held.scope.force()));
  }
  double dc = 0, above = 0;
  for (int k = 0; k <= kTicks / 2; ++k) {
    std::complex<double> sum = 0;
    for (int i = 0; i < kTicks; ++i)
      sum += force[static_cast<std::size_t>(i)] *
             std::polar(1.0, -2 * std::numbers::pi * k * i / kTicks);
    if (k == 0) dc = std::abs(sum) / kTicks;
    if (k > 100) above += 2 * std::norm(sum / static_cast<double>(kTicks));
  }
  std::printf("8-bit staircase in the hand: %.3f N, %.4f %% of it above 100 Hz\n", dc,
              100 * std::sqrt(above / 2) / dc);
  EXPECT_GT(dc, 0.1);
  EXPECT_LT(std::sqrt(above / 2), 0.05 * dc);
}

// The reported stiffness of a tissue may be any number and its curvature any matrix. A hand of 300
// N/m moves the instrument in circles through the surface.
TEST(HardCase14, AnyReportedStiffnessIsMadePassive) {
  LoadedScene bare = SceneOf({}, {});
  bare.scene.tissues.clear();
  bare.surfaces.clear();
  constexpr double kLevel = 0.03, kRound = 0.5;  // m; s
  std::mt19937 random(14);
  std::normal_distribution<double> normal;
  double most = -1;
  for (int seed = 0; seed < 40; ++seed) {
    TouchedSkin skin;
    skin.stiffness = (seed % 2 == 0 ? 1e3 : 1e6) * normal(random);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        skin.curvature[i][j] = (seed % 4 < 2 ? 300 : 1e5) * normal(random);
    Session session(bare);
    PlantOptions plant;
    plant.friction = 0;
    const glm::dvec3 middle(0, 0, kLevel + 1e-3);
    PlantDevice device(plant, kHand, HipFromRodPose(PoseAt(middle), session.instrument_rig()));
    ServoLoop loop(session, nullptr, &device);
    ServoRequest request{session.options(), 0, 0, {}, {}, ToolKind::kProbe, {false, false}};
    loop.SetRequest(request);
    double now = 0, work = 0;
    std::uint64_t step = 0;
    for (int i = 0; i < 6000; ++i) {
      if (i == 10) {
        request.is_dead_man_held = {true, true};
        loop.SetRequest(request);
      }
      if (i % 16 == 0) {
        // Coupling of a tissue step, at the present tip.
        const glm::dvec3 tip = session.snapshot().instrument.tissue_tip_in_portal;
        const double depth = tip.z - kLevel;
        ContactPoint contact;
        contact.owner = 3;
        contact.normal = {0, 0, 1};
        contact.friction = 0.2;
        ContactResult result;
        result.gap = -depth;
        result.push = result.force = {0, 0, depth > 0 ? 300 * depth : 0.0};
        skin.depth = std::max(0.0, depth);
        ToolCoupling coupling;
        coupling.step = ++step;
        coupling.tip = tip;
        AddContacts({&contact, 1}, {&result, 1}, 3, skin, session.options().contact.stiffness,
                    {1, 0, 0, 0}, 0, coupling);
        ASSERT_EQ(coupling.count, 1);
        ASSERT_FALSE(coupling.is_faulty);
        ASSERT_GE(coupling.contact[0].stiffness, 0.0);
        ASSERT_LE(coupling.contact[0].stiffness, session.options().contact.stiffness);
        session.SetCoupling(coupling);
      }
      const double angle = 2 * std::numbers::pi * i * kTick / kRound;
      const glm::dvec3 tip =
          middle + glm::dvec3(1.5e-3 * std::sin(angle), 0, 1.5e-3 * std::cos(angle));
      device.plant().SetIntent(HipFromRodPose(PoseAt(tip), session.instrument_rig()));
      loop.TickOnce(now += kTick);
      ASSERT_TRUE(std::isfinite(glm::length(device.force()))) << seed;
      // Counts whole rounds, once it is armed, ramped and periodic.
      if (i >= 2000 && i % 500 == 0) {
        if (i > 2000) most = std::max(most, device.plant().work() - work);
        work = device.plant().work();
      }
    }
    EXPECT_EQ(session.snapshot().instrument.fault, Fault::kNone) << seed;
  }
  std::printf("any local stiffness: at most %.3f mJ out of a round\n", 1e3 * most);
  EXPECT_LT(most, 1e-3);
}

// The hand passes the incision and returns, 1 mm beside it and exactly through it, with its tip in
// the wall.
TEST(HardCase15, ForceFadesWithoutFlutterWhereTheHandCrossesTheIncision) {
  const AnalyticRelief relief = Flat();
  for (const double beside : {0.0, 1e-6, 1e-3, 4e-3}) {
    LoadedScene loaded = SceneOver(relief, relief.Float());
    loaded.scene.rig.scope.rod_length = 0.06;  // in the wall up to 14 mm from the incision
    Session session(loaded);
    glm::dvec3 last(0.0);
    int turns = 0, felt = 0;
    double t = 0;
    // Rests until the force is ramped, then moves through at 20 mm/s and back.
    for (int i = 0; i < 1000 + 2 * 1400; ++i) {
      const int way = std::clamp(i - 1000, 0, 2 * 1400);
      const double z = -0.0139 + 2e-5 * (way < 1400 ? way : 2 * 1400 - way);
      DeviceSample sample;
      sample.t = t += kTick;
      sample.hip_in_device = {beside, 0, z};
      sample.valid = true;
      session.Tick(sample, {}, kTick);
      const ToolState& tool = session.snapshot().scope;
      const double r = std::hypot(beside, z);
      ExpectWithinRise(tool.hand_force, last, session.options().limiter);
      if (HasFatalFailure()) return;
      ASSERT_TRUE(std::isfinite(glm::length(tool.tip_in_portal)));
      if (r < 5e-3) {
        ASSERT_EQ(tool.hand_force, glm::dvec3(0.0)) << r;
      }
      // Checks perceptible forces only.
      turns += glm::dot(tool.hand_force, last) < 0 && glm::length(last) > 1e-3;
      felt += glm::length(tool.hand_force) > 0.01;
      last = tool.hand_force;
    }
    EXPECT_GT(felt, 200) << "else nothing was touched";
    EXPECT_LE(turns, 2) << beside << ": once there and once back";
  }
}

// Hand forces of that replay, N; gcc 12.2 and clang 14 on x86-64 give the same bits.
struct KnownForce {
  std::size_t row;
  glm::dvec3 hand;
};
const KnownForce kKnownForces[] = {
    {4999, {0, 0, 0}},
    {14972, {0.23159023919859478, 0.24391275407491314, -0.47259861602601794}},
    {24945, {0, 0, 0}},
    {34918, {0.025599985194874074, -0.0049725841403537221, -0.14653267522967861}},
    {44891, {0.8534583494158553, 0.19088609132751683, -1.157760566665442}},
    {54864, {0, 0, 0}},
    {64837, {0, 0, 0}},
    {74810, {0, 0, 0}},
    {84783, {0.10729645618939013, -0.02497563055125613, -0.13142127805393292}},
    {94756, {-0.0097379163052821113, -0.059810126804438743, -0.11170496516436376}},
    {104729, {0.84299067862694366, 0.17267103026412761, -1.2777223757199325}},
    {114702, {0, 0, 0}},
};

// Ten minutes of both hands over hilly ground: three bit-identical runs, within 1 nN of other
// compilers.
TEST(HardCase27, TenMinutesAreBitIdenticalOverThreeRuns) {
  const AnalyticRelief relief = AnalyticRelief::Waves(ProjectionType::kGnomonic);
  const LoadedScene loaded = SceneOver(relief, relief.EightBit());
  const Session session(loaded);
  ScriptedDevice scope(session.scope_rig()), instrument(session.instrument_rig());
  std::vector<TraceRow> trace;
  for (int i = 0; i <= 60000; ++i) {
    const double t = 0.01 * i;
    scope.Set({0.3 * std::sin(0.7 * t), 0.25 * std::sin(0.31 * t), 0.2 * t,
               0.0465 + 0.0015 * std::sin(2.1 * t)});
    instrument.Set({0.2 * std::sin(0.5 * t), -0.4 + 0.2 * std::sin(0.23 * t), 0,
                    0.0505 + 0.002 * std::sin(1.7 * t)});
    trace.push_back({DeviceRole::kScope, scope.Sample(t)});
    trace.push_back({DeviceRole::kInstrument, instrument.Sample(t)});
  }
  const std::vector<ForceRow> first = Replay(loaded, {trace, {}});
  ASSERT_EQ(first.size(), trace.size());
  double sum = 0;
  for (const ForceRow& row : first) sum += glm::length(row.state.hand_force);
  EXPECT_GT(sum / static_cast<double>(first.size()), 0.05) << "else nothing was touched";
  for (const KnownForce& known : kKnownForces)
    EXPECT_LT(glm::distance(first[known.row].state.hand_force, known.hand), 1e-9) << known.row;
  for (int run = 0; run < 2; ++run) {
    const std::vector<ForceRow> again = Replay(loaded, {trace, {}});
    ASSERT_EQ(again.size(), first.size());
    for (std::size_t i = 0; i < first.size(); ++i) {
      ASSERT_EQ(again[i].state.tip_force, first[i].state.tip_force) << i;
      ASSERT_EQ(again[i].state.hand_force, first[i].state.hand_force) << i;
      ASSERT_EQ(again[i].state.proxy_in_portal, first[i].state.proxy_in_portal) << i;
    }
  }
}

// Moves at 0.1 mm/s along a wall for 60 s, then rests for 20 s, with friction, quantum and delay of
// a device. A limit cycle would swing without end, so that nine tenths of the ticks within 0.1 s
// differ by more than the allowed swing. The passivity guard must not react to each count of the
// device either, which looks like 55 mm/s.
TEST(HardCase23, ASlowStrokeComesToRestWithoutALimitCycle) {
  const AnalyticRelief relief = Flat();
  for (const HandModel& hand : {kSoftHand, kHand, kStiffHand}) {
    const auto tip_at = [](double along) {
      return 0.048 * glm::normalize(glm::dvec3(along, 0, 0.048));
    };
    Held held(SceneOver(relief, relief.Float()), tip_at(-3e-3), {}, hand);
    double swing = 0, strike = 0;
    int strikes = 0;
    glm::dvec3 last = held.scope.force();
    std::array<std::vector<double>, 3> window;  // 0.1 s of each axis: swings of 10 Hz and more
    for (int i = 0; i < 60000; ++i) {
      held.Tick(tip_at(-3e-3 + 1e-4 * i * kTick));
      const double step =
          glm::distance(held.scope.force(), std::exchange(last, held.scope.force()));
      strike = std::max(strike, step);
      strikes += step > kFrictionOfDevice;
      for (int axis = 0; axis < 3; ++axis) {
        auto& forces = window[static_cast<std::size_t>(axis)];
        forces.push_back(held.scope.force()[axis]);
        if (forces.size() < 100) continue;
        std::ranges::sort(forces);
        swing = std::max(swing, forces[94] - forces[5]);
        forces.clear();
      }
    }
    for (int i = 0; i < 2000; ++i) held.Tick(tip_at(3e-3));
    const glm::dvec3 still = held.scope.plant().position();
    EXPECT_GT(glm::length(held.scope.force()), 0.05);
    for (int i = 0; i < 18000; ++i) held.Tick(tip_at(3e-3));
    const double drift = glm::distance(held.scope.plant().position(), still);
    std::printf(
        "hand of %.0f N/m: swing %.3f N, drift %.4f mm in 18 s; %d of 60000 ticks step by more "
        "than "
        "%.2f N, %.2f at most\n",
        hand.stiffness, swing, 1e3 * drift, strikes, kFrictionOfDevice, strike);
    EXPECT_LT(drift, 1e-5);
    EXPECT_LT(swing, kFrictionOfDevice);
    EXPECT_LT(strikes, 10);
  }
}

}  // namespace
}  // namespace arthro::simulation

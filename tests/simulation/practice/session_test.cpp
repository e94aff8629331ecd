#include "simulation/practice/session.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/scope/arthroscope.h"
#include "tests/simulation/practice/hand.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/shapes.h"

namespace arthro::simulation {
namespace {

// Flat relief of 4 mm on a sphere of 50 mm, with a box of tissue in front of it.
LoadedScene MakeScene(bool has_depth = true, bool has_tissue = true) {
  LoadedScene loaded;
  loaded.scene.backdrop.radius = 0.05;
  loaded.scene.backdrop.projection.centre_px = {511.5, 511.5};
  loaded.scene.backdrop.projection.focal_px = 500;
  loaded.scene.portals.incision_spacing = 0.03;
  loaded.panorama = Share(ColourImage(1024, 1024));
  if (has_depth) loaded.depth = Share(DepthMap(1024, 1024, 0.004f));
  if (has_tissue) {
    Tissue tissue;
    tissue.name = "box";
    tissue.pose.position = {0.01, 0, 0.04};
    loaded.scene.tissues.push_back(tissue);
    loaded.surfaces.push_back(Share(test::Box(glm::dvec3(-0.004), glm::dvec3(0.004))));
  }
  return loaded;
}

// Snapshot of both tools after the ticks.
struct Hands : Hand {
  using Hand::Hand;
  const Snapshot& Tick(int ticks = 1) {
    Hand::Tick(ticks);
    return session.snapshot();
  }
  const Snapshot& Lead(const glm::dvec3& tip, int ticks) {
    Hand::Lead(tip, ticks, 0);
    return session.snapshot();
  }
};

TEST(Session, ToolTipsAreInThePortalFrame) {
  Hands hands(MakeScene());
  hands.scope.Set({0.1, -0.2, 0.3, 0.02});
  hands.instrument.Set({0.1, -0.2, 0, 0.025});
  const Snapshot& snapshot = hands.Tick();
  const glm::dvec3 u = BasisOf({0.1, -0.2, 0, 0}).axis;
  EXPECT_LT(glm::length(snapshot.scope.tip_in_portal - 0.02 * u), 1e-12);
  EXPECT_LT(glm::length(snapshot.instrument.tip_in_portal - glm::dvec3(0.03, 0, 0) - 0.025 * u),
            1e-12);
  EXPECT_NEAR(snapshot.t, kTick, 1e-15);
}

TEST(Session, PixelsAreTheCentreOfTheViewAndThePointUnderTheTip) {
  const LoadedScene loaded = MakeScene();
  Hands hands(loaded);
  const RodPose pose{0.1, -0.2, 0.8, 0.02};
  hands.scope.Set(pose);
  hands.instrument.Set({0, -0.5, 0, 0.03});
  const Snapshot& snapshot = hands.Tick();
  const auto centre = PixelFromDirection(
      loaded.scene.backdrop.projection,
      CentreDirection(pose, loaded.scene.scope.view_angle, loaded.scene.backdrop.radius));
  ASSERT_TRUE(centre);
  EXPECT_LT(glm::length(snapshot.scope.pixel - *centre), 1e-6);
  const glm::dvec3 tip = snapshot.instrument.tip_in_portal;
  EXPECT_NEAR(snapshot.instrument.pixel.x, 511.5 + 500 * tip.x / tip.z, 1e-9);
  // A tip that is drawn out behind the portal is over no pixel.
  hands.instrument.Set({0, 0, 0, -0.01});
  EXPECT_TRUE(std::isnan(hands.Tick().instrument.pixel.x));
}

TEST(Session, ViewAngleIsLive) {
  Hands hands(MakeScene());
  hands.scope.Set({0, 0, 0, 0.02});
  hands.session.SetViewAngle(0.0);
  EXPECT_NEAR(hands.Tick().scope.pixel.y, 511.5, 1e-9);
  hands.session.SetViewAngle(0.5);
  EXPECT_LT(hands.Tick().scope.pixel.y, 400.0) << "with no roll an oblique scope looks up";
}

TEST(Session, BothToolsFeelTheBackdrop) {
  Hands hands(MakeScene(true, false));
  hands.scope.Set({0, 0, 0, 0.047});
  hands.Lead({0, 0, 0.047}, 2000);
  const Snapshot& snapshot = hands.Tick(1000);
  for (const ToolState* tool : {&snapshot.scope, &snapshot.instrument}) {
    EXPECT_EQ(tool->contact, kBackdropContact);
    EXPECT_EQ(tool->fault, Fault::kNone);
    EXPECT_NEAR(tool->penetration, 0.001, 3e-5);
    EXPECT_NEAR(tool->tip_force.z, -0.5, 0.02);
    EXPECT_NEAR(glm::length(tool->proxy_in_portal), 0.046, 1e-5);
  }
  // The rod of the scope is along z, so hand and tip force are equal.
  EXPECT_NEAR(snapshot.scope.hand_force.z, -0.5, 1e-3);
  // The instrument comes in from the side; across its rod, 1 − 0.2/r < 0 reverses the force.
  EXPECT_GT(glm::length(snapshot.instrument.hand_force - snapshot.instrument.tip_force), 0.01);
}

TEST(Session, InstrumentFeelsTissueInFrontOfTheBackdrop) {
  Hands hands(MakeScene());
  const Snapshot& snapshot = hands.Lead({0.0115, 0, 0.0368}, 3000);
  EXPECT_EQ(snapshot.instrument.contact, 1);
  EXPECT_EQ(snapshot.scope.contact, kNoContact);
  EXPECT_GT(glm::length(snapshot.instrument.tip_force), 0.1);
}

TEST(Session, MovedIncisionMovesTheInstrumentOnly) {
  Hands hands(MakeScene());
  hands.instrument.Set({0, 0, 0, 0.02});
  hands.Tick(10);
  hands.session.SetIncisionSpacing(-0.025);
  const Snapshot& snapshot = hands.Tick();
  EXPECT_NEAR(snapshot.instrument.tip_in_portal.x, -0.025, 1e-12);
  EXPECT_NEAR(snapshot.scope.tip_in_portal.x, 0.0, 1e-12);
}

TEST(Session, HandForceRampsFromZeroAndIsLimited) {
  Hands hands(MakeScene(true, false));
  hands.scope.Set({0, 0, 0, 0.049});  // 3 mm deep at the first sample
  double last = 0;
  for (int i = 1; i <= 600; ++i) {
    const ToolState& scope = hands.Tick().scope;
    const double force = glm::length(scope.hand_force);
    EXPECT_GE(force, last - 1e-12);
    EXPECT_LE(force, 1.5 * std::min(1.0, i * kTick / 0.5) + 1e-6);
    last = force;
  }
  EXPECT_NEAR(last, 1.5, 1e-3);
}

TEST(Session, StaleAndLostSamplesGetNoForce) {
  Hands hands(MakeScene(true, false));
  hands.scope.Set({0, 0, 0, 0.047});
  hands.Tick(1000);
  ASSERT_GT(glm::length(hands.session.snapshot().scope.hand_force), 0.4);
  const DeviceSample held = hands.scope.Sample(hands.t);
  for (int i = 1; i <= 30; ++i) {
    hands.session.Tick(held, {}, kTick);
    if (i == 5 || i == 20) continue;  // on the limit, rounding decides
    const ToolState& scope = hands.session.snapshot().scope;
    const Fault expected = i < 5 ? Fault::kNone : i < 20 ? Fault::kStale : Fault::kLost;
    EXPECT_EQ(scope.fault, expected) << i;
    EXPECT_EQ(glm::length(scope.hand_force) > 0, i < 5) << i;
  }
  // After a fresh sample the force ramps up.
  hands.Tick();
  EXPECT_EQ(hands.session.snapshot().scope.fault, Fault::kNone);
  EXPECT_LT(glm::length(hands.session.snapshot().scope.hand_force), 0.01);
}

TEST(Session, BadSamplesGiveAFaultAndNoForce) {
  Hands hands(MakeScene(true, false));
  hands.scope.Set({0, 0, 0, 0.047});
  hands.Tick(1000);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (double bad : {nan, std::numeric_limits<double>::infinity(), 1e300}) {
    DeviceSample sample = hands.scope.Sample(hands.t += kTick);
    sample.hip_in_device.x = bad;
    hands.session.Tick(sample, {}, kTick);
    const ToolState& scope = hands.session.snapshot().scope;
    EXPECT_NE(scope.fault, Fault::kNone);
    EXPECT_EQ(scope.hand_force, glm::dvec3(0.0));
    EXPECT_TRUE(std::isfinite(scope.tip_in_portal.x)) << "what is drawn stays finite";
  }
  // A finite position that no hand can have is a fault from the first sample on.
  Session fresh(MakeScene(true, false));
  for (const glm::dvec3& far :
       {glm::dvec3(1e300, 0, 0), glm::dvec3(0, -11, 0), glm::dvec3(1e160)}) {
    for (int i = 0; i < 3; ++i) {
      DeviceSample sample = hands.scope.Sample(hands.t += kTick);
      sample.hip_in_device = far;
      fresh.Tick(sample, sample, kTick);
      for (const ToolState& tool : {fresh.snapshot().scope, fresh.snapshot().instrument}) {
        EXPECT_EQ(tool.fault, Fault::kTooFar) << far.x << " " << far.y;
        EXPECT_EQ(tool.hand_force, glm::dvec3(0.0));
        EXPECT_EQ(tool.tip_force, glm::dvec3(0.0));
      }
    }
  }
  DeviceSample gone = hands.scope.Sample(hands.t += kTick);
  gone.valid = false;
  hands.session.Tick(gone, {}, kTick);
  EXPECT_EQ(hands.session.snapshot().scope.fault, Fault::kNoSample);
  EXPECT_EQ(hands.session.snapshot().scope.contact, kNoContact);
  hands.Tick(1000);
  EXPECT_NEAR(hands.session.snapshot().scope.tip_force.z, -0.5, 1e-3) << "it recovers";
}

TEST(Session, FastHandGetsNoForce) {
  Hands hands(MakeScene(true, false));
  hands.scope.Set({0, 0, 0, 0.047});
  hands.Tick(1000);
  hands.scope.Advance({0, 0, 0, 0.0012});  // per tick: 1.2 m/s
  EXPECT_EQ(hands.Tick().scope.fault, Fault::kTooFast);
  EXPECT_EQ(hands.session.snapshot().scope.hand_force, glm::dvec3(0.0));
}

TEST(Session, SceneWithoutDepthFeelsTheBareSphere) {
  Hands hands(MakeScene(false, false));
  hands.scope.Set({0, 0, 0, 0.051});
  EXPECT_NEAR(hands.Tick(10).scope.tip_force.z, -0.5, 1e-6);
}

TEST(Session, SceneWithNothingToTouchHasNoForce) {
  LoadedScene loaded = MakeScene(false, false);
  loaded.panorama = nullptr;
  Hands hands(loaded);
  hands.scope.Set({0, 0, 0, 0.06});
  EXPECT_EQ(hands.Tick(10).scope.tip_force, glm::dvec3(0.0));
  EXPECT_EQ(hands.session.snapshot().scope.contact, kNoContact);
}

// Coupling of a tissue that is a spring of 300 N/m at z = 0.030 m, pushing towards the portal.
ToolCoupling TissueSpring(const glm::dvec3& tip, std::uint64_t step, double k = 300.0,
                          double level = 0.030) {
  ToolCoupling coupling;
  coupling.step = step;
  coupling.tip = tip;
  coupling.count = 1;
  coupling.contact[0].normal = {0, 0, -1};
  coupling.contact[0].depth = tip.z - level;
  coupling.contact[0].stiffness = k;
  coupling.contact[0].spring = 500.0;
  coupling.contact[0].tissue = 0;
  return coupling;
}

TEST(LiveTissue, GivesTheForceOfItsCouplingAndHoldsTheDrawnTool) {
  Hands hands(MakeScene(false, false));
  hands.Lead({0.03, 0, 0.032}, 1000);
  for (int step = 1; step <= 20; ++step) {
    hands.session.SetCoupling(
        TissueSpring(hands.session.snapshot().instrument.tip_in_portal, step));
    hands.Tick(16);
  }
  const ToolState& tool = hands.session.snapshot().instrument;
  EXPECT_NEAR(tool.tip_force.z, -300.0 * 0.002, 1e-9);
  EXPECT_NEAR(tool.proxy_in_portal.z, 0.032 - 300.0 * 0.002 / 500.0, 2e-8) << "10 uN of the spring";
  EXPECT_EQ(tool.contact, 1);
  EXPECT_NEAR(tool.penetration, 0.0012, 1e-9);
  EXPECT_EQ(tool.fault, Fault::kNone);
  EXPECT_EQ(hands.session.snapshot().scope.contact, kNoContact) << "only the instrument touches it";
}

// The hand is 1 mm deep in the backdrop at 46 mm, and 0.5 mm deeper in tissue that lies on it.
TEST(LiveTissue, BackdropAndTissueTogetherAreNotCountedTwice) {
  SessionOptions options;
  options.contact.static_friction = options.contact.sliding_friction = 0.0;
  Hands hands(MakeScene(true, false), options);
  hands.session.SetIncisionSpacing(0.0);
  hands.Lead({0, 0, 0.047}, 2000);
  hands.Tick(500);
  const double alone = hands.session.snapshot().instrument.tip_force.z;
  EXPECT_NEAR(alone, -0.5, 0.02);
  const auto press = [&](double k) {
    for (int step = 1; step <= 20; ++step) {
      hands.session.SetCoupling(TissueSpring(hands.session.snapshot().instrument.tip_in_portal,
                                             static_cast<std::uint64_t>(1000 * k) + step, k,
                                             0.0455));
      hands.Tick(16);
    }
    return hands.session.snapshot().instrument;
  };
  // A soft tissue, half a millimetre before the backdrop, holds the tool less than the backdrop
  // does: the backdrop still has it at its surface, and the force is that of the one spring between
  // tip and surface. The tissue is pressed by no more than the backdrop lets the tool go:
  // F = 200 N/m (0.5 mm + F/k), so 0.167 N of the 0.5 N.
  const ToolState soft = press(200.0);
  EXPECT_NEAR(soft.tip_force.z, alone, 2e-3);
  EXPECT_NEAR(glm::length(soft.proxy_in_portal), 0.046, 1e-5);
  EXPECT_EQ(soft.contact, kBackdropContact) << "0.17 N of the tissue, the rest of the backdrop";
  // A stiff tissue (in series with the tool's own 500 N/m) holds it off: 400 N/m · 1.5 mm.
  const ToolState stiff = press(400.0);
  EXPECT_NEAR(stiff.tip_force.z, -0.6, 2e-3);
  EXPECT_EQ(stiff.contact, 1);
}

TEST(LiveTissue, IsNotARigidSurface) {
  Hands hands(MakeScene());
  hands.session.SetLiveTissues(std::array<std::uint8_t, 1>{1});
  EXPECT_EQ(hands.Lead({0.0115, 0, 0.0368}, 3000).instrument.contact, kNoContact);
  hands.Lead({0.03, 0, 0.02}, 1000);
  hands.session.SetLiveTissues({});
  EXPECT_EQ(hands.Lead({0.0115, 0, 0.0368}, 3000).instrument.contact, 1);
}

// HAP-16: a NaN coupling is a fault, and the session continues.
TEST(LiveTissue, HardCase16ACouplingThatIsNotANumberGivesNoForceAndAFault) {
  Hands hands(MakeScene(false, false));
  hands.Lead({0.03, 0, 0.032}, 1000);
  std::uint64_t step = 0;
  const auto feel = [&](int frames) {
    for (int i = 0; i < frames; ++i) {
      hands.session.SetCoupling(
          TissueSpring(hands.session.snapshot().instrument.tip_in_portal, ++step));
      hands.Tick(16);
    }
  };
  feel(40);
  EXPECT_GT(glm::length(hands.session.snapshot().instrument.hand_force), 0.1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (int kind = 0; kind < 3; ++kind) {
    ToolCoupling bad = TissueSpring({0.03, 0, 0.032}, ++step);
    if (kind == 0) bad.contact[0].rub.x = nan;
    if (kind == 1) bad.contact[0].stiffness = std::numeric_limits<double>::infinity();
    if (kind == 2) bad.is_faulty = true;
    hands.session.SetCoupling(bad);
    const ToolState& tool = hands.Tick(3).instrument;
    EXPECT_EQ(tool.fault, Fault::kTissue) << kind;
    EXPECT_EQ(tool.tip_force, glm::dvec3(0.0));
    EXPECT_EQ(tool.hand_force, glm::dvec3(0.0));
    EXPECT_TRUE(std::isfinite(tool.proxy_in_portal.z));
    EXPECT_EQ(hands.session.snapshot().scope.fault, Fault::kNone);
    // The next valid step gives a force again, rising from zero.
    feel(1);
    EXPECT_EQ(hands.session.snapshot().instrument.fault, Fault::kNone);
    EXPECT_LT(glm::length(hands.session.snapshot().instrument.hand_force), 0.05);
    feel(40);
    EXPECT_GT(glm::length(hands.session.snapshot().instrument.hand_force), 0.1);
  }
}

TEST(LiveTissue, ATissueThatAppearsGivesNoForceJump) {
  Hands hands(MakeScene(false, false));
  hands.Lead({0.03, 0, 0.036}, 1000);
  hands.Tick(1000);
  hands.session.SetCoupling(TissueSpring({0.03, 0, 0.036}, 1));
  glm::dvec3 last(0.0);
  double largest = 0;
  for (int i = 0; i < 100; ++i) {
    const glm::dvec3 force = hands.Tick().instrument.tip_force;
    largest = std::max(largest, glm::length(force - last));
    last = force;
  }
  EXPECT_NEAR(last.z, -1.8, 1e-6);
  EXPECT_LT(largest, 1.8 * 60 * kTick * 1.01) << "over a frame";
}

// Changes from 60 steps per second to five: the last coupling gives force for 0.1 s and fades, and
// the next one is blended in over a frame.
TEST(LiveTissue, HardCase13FiveStepsPerSecondGiveNoJumpsAndAFadingForce) {
  Hands hands(MakeScene(false, false));
  hands.Lead({0.03, 0, 0.032}, 1000);
  double largest = 0, strongest = 0, last = 0, faded = 1;
  for (int step = 1; step <= 10; ++step) {
    hands.session.SetCoupling(
        TissueSpring(hands.session.snapshot().instrument.tip_in_portal, step));
    for (int i = 0; i < 200; ++i) {
      const double force = glm::length(hands.Tick().instrument.tip_force);
      if (step > 1 || i > 0) largest = std::max(largest, std::abs(force - last));
      strongest = std::max(strongest, force);
      if (i == 155) faded = std::min(faded, force);
      last = force;
    }
    EXPECT_EQ(last, 0.0) << step;
  }
  EXPECT_NEAR(strongest, 0.6, 1e-6);
  EXPECT_EQ(faded, 0.0);
  EXPECT_LE(largest, 0.6 * 60 * kTick * 1.01) << "over a frame";
}

TEST(LiveTissue, HardCase13ForceFadesWithoutFurtherSteps) {
  Hands hands(MakeScene(false, false));
  hands.Lead({0.03, 0, 0.032}, 1000);
  hands.session.SetCoupling(TissueSpring({0.03, 0, 0.032}, 1));
  EXPECT_NEAR(hands.Tick(90).instrument.tip_force.z, -0.6, 1e-6);
  EXPECT_EQ(hands.Tick(70).instrument.tip_force, glm::dvec3(0.0));
}

// The tip stays 4 mm below the backdrop while the instrument is changed.
TEST(Session, AChangedInstrumentEntersAnewAndItsForceRisesFromZero) {
  Hands hands(MakeScene(true, false));
  hands.instrument.Set({0, -0.5, 0, 0.04});
  hands.Tick(700);  // armed, in free space
  const glm::dvec3 tip(0, 0, 0.05);
  hands.Lead(tip, 400);
  const double before = glm::length(hands.Tick(200).instrument.tip_force);
  ASSERT_NEAR(before, 2.0, 0.01);
  hands.session.SetInstrument(hands.session.instrument());
  EXPECT_NEAR(glm::length(hands.Tick().instrument.tip_force), before, 1e-6) << "the same one";
  for (const ToolKind kind : {ToolKind::kShaver, ToolKind::kPunch, ToolKind::kProbe}) {
    hands.session.SetInstrument(kind);
    double last_tip = 0, last_hand = 0;
    const double ramp = hands.session.options().limiter.ramp_time;
    for (int i = 0; i < 600; ++i) {
      const ToolState& tool = hands.Tick().instrument;
      const double at_tip = glm::length(tool.tip_force), in_hand = glm::length(tool.hand_force);
      // Allows a fifth more: the proxy comes straight from the portal and slides to the nearest
      // point.
      ASSERT_LE(at_tip, 1.2 * before * std::min(1.0, i * kTick / ramp) + 1e-6) << i;
      ASSERT_LE(at_tip - last_tip, 1.2 * before * kTick / ramp) << i;
      ASSERT_LE(in_hand - last_hand, 0.02) << i;
      last_tip = at_tip;
      last_hand = in_hand;
    }
    EXPECT_NEAR(last_tip, before, 1e-3) << "as the one before, once it is ramped";
    EXPECT_GT(last_hand, 0.5);
  }
}

// The tip stays 4 mm in living tissue of 300 N/m.
TEST(LiveTissue, AnotherInstrumentsForceRisesFromZero) {
  Hands hands(MakeScene(false, false));
  hands.Lead({0.03, 0, 0.034}, 1000);
  std::uint64_t step = 0;
  const auto tick = [&]() -> const ToolState& {
    if (step++ % 16 == 0)
      hands.session.SetCoupling(
          TissueSpring(hands.session.snapshot().instrument.tip_in_portal, step));
    return hands.Tick().instrument;
  };
  for (int i = 0; i < 600; ++i) tick();
  const double before = glm::length(hands.session.snapshot().instrument.tip_force);
  ASSERT_NEAR(before, 1.2, 1e-6);
  const double ramp = hands.session.options().limiter.ramp_time;
  for (const ToolKind kind : {ToolKind::kShaver, ToolKind::kPunch, ToolKind::kProbe}) {
    hands.session.SetInstrument(kind);
    for (int i = 0; i < 600; ++i) {
      const double at_tip = glm::length(tick().tip_force);
      ASSERT_LE(at_tip, before * std::min(1.0, i * kTick / ramp) + 1e-6) << i;
    }
    EXPECT_NEAR(glm::length(hands.session.snapshot().instrument.tip_force), before, 1e-6);
  }
}

TEST(ServoTick, AllocatesNothing) {
  LoadedScene loaded = MakeScene();
  loaded.surfaces[0] = Share(test::Sphere({0, 0, 0}, 0.005, 5));
  Hands hands(loaded);
  const long before = test::Allocations();
  for (int i = 0; i < 3000; ++i) {
    const double s = i * kTick;
    hands.scope.Set({0.3 * std::sin(s), 0.4 * std::sin(2 * s), s, 0.046 + 0.002 * std::sin(5 * s)});
    hands.instrument.Set({0.1 * std::sin(3 * s), -0.5 + 0.2 * std::sin(s), s, 0.043});
    hands.Tick();
    if (i == 1500) hands.session.SetIncisionSpacing(-0.03);
    if (i % 16 == 0)
      hands.session.SetCoupling(TissueSpring(hands.session.snapshot().instrument.tip_in_portal,
                                             static_cast<std::uint64_t>(1 + i / 16)));
  }
  EXPECT_EQ(test::Allocations(), before);
}

static_assert(noexcept(std::declval<Session&>().SetCoupling(std::declval<const ToolCoupling&>())));
static_assert(noexcept(std::declval<Session&>().Tick(std::declval<const DeviceSample&>(),
                                                     std::declval<const DeviceSample&>(), 0.001)));

}  // namespace
}  // namespace arthro::simulation

#include "simulation/practice/device_options.h"

#include <gtest/gtest.h>

#include "simulation/core/options_json.h"
#include "simulation/device/plant_device.h"
#include "tests/simulation/practice/hand.h"

namespace arthro::simulation {
namespace {

DeviceCaps TouchClass() {
  DeviceCaps caps = PlantDevice({}, kHand, glm::dvec3(0.0)).caps();
  caps.max_stiffness = 0;
  return caps;
}

TEST(DeviceOptions, StableStiffnessMatchesTheTable) {
  ContactOptions contact;
  contact.stiffness = 10;
  // Columns: T, B, delay in ticks, N/m.
  struct Row {
    double period, damping, ticks, bound;
  };
  for (const Row& row : {Row{1e-3, 0, 0, 400}, Row{1e-3, 0, 1, 133.3}, Row{1e-3, 1, 1, 800},
                         Row{1e-3, 1, 2, 480}, Row{2e-3, 1, 0, 1200}, Row{0.5e-3, 1, 1, 1600}}) {
    contact.damping = row.damping;
    EXPECT_NEAR(StableStiffness(0.2, contact, row.period, row.ticks * row.period), row.bound, 0.1);
  }
}

TEST(DeviceOptions, ALoweredCouplingIsStableWithItsReducedViscosity) {
  ContactOptions contact;
  contact.stiffness = 3000;
  const double lowered = StableStiffness(0.2, contact, 1e-3, 1e-3);
  const double viscosity = contact.damping * lowered / contact.stiffness;
  EXPECT_NEAR(lowered * 1.5e-3, 0.2 + viscosity, 1e-12);
  EXPECT_LT(lowered, 200);
}

TEST(DeviceOptions, DefaultsAreStableForATouchClassDevice) {
  const SessionOptions options = OptionsFor(TouchClass(), 1e-3, {});
  EXPECT_EQ(options.lever.max_stiffness, 780) << "the rule gives 800";
  EXPECT_EQ(options.limiter.max_force, 3.3);
  EXPECT_NEAR(options.thermal.continuous_force, 0.88, 1e-12);
}

TEST(DeviceOptions, OnlyLowerLimits) {
  SessionOptions low;
  low.lever.max_stiffness = 100;
  low.limiter.max_force = 1;
  low.thermal.continuous_force = 0.5;
  low.passivity.delay = 7;
  low.passivity.quantum = 1e-3;
  const SessionOptions same = OptionsFor(TouchClass(), 1e-3, low);
  EXPECT_EQ(JsonFromOptions(same), JsonFromOptions(low));
  DeviceCaps weak = TouchClass();
  weak.peak_force = 2;
  weak.continuous_force = 0.4;
  weak.max_stiffness = 300;
  for (const bool is_weak_first : {false, true}) {
    SessionOptions both = OptionsFor(is_weak_first ? weak : TouchClass(), 1e-3, {});
    both = OptionsFor(is_weak_first ? TouchClass() : weak, 1e-3, both);
    EXPECT_EQ(both.limiter.max_force, 2);
    EXPECT_EQ(both.lever.max_stiffness, 300);
    EXPECT_EQ(both.thermal.continuous_force, 0.4);
  }
  // A longer period and later reports allow less.
  EXPECT_LT(OptionsFor(TouchClass(), 4e-3, {}).lever.max_stiffness,
            OptionsFor(TouchClass(), 1e-3, {}).lever.max_stiffness);
}

TEST(DeviceOptions, ADeviceWithoutForceChangesNothing) {
  DeviceCaps pad = TouchClass();
  pad.feedback = Feedback::kRumble;
  pad.peak_force = 0.1;
  EXPECT_EQ(JsonFromOptions(OptionsFor(pad, 1e-3, {})), JsonFromOptions(SessionOptions{}));
}

// Ratio of the hand force of a surface to that without a device.
TEST(DeviceOptions, LowerTheForceOfASurface) {
  LoadedScene loaded = SceneOf({}, {});
  loaded.scene.tissues.clear();
  loaded.surfaces.clear();
  DeviceCaps weak = TouchClass();
  weak.max_stiffness = 250;
  weak.peak_force = 0.3;
  double force[2], tip[2];
  for (const bool has_device : {false, true}) {
    Hand hand(loaded, has_device ? OptionsFor(weak, 1e-3, {}) : SessionOptions{});
    hand.scope.Set({0, 0, 0, 0.0816});
    hand.Tick(1000);
    tip[has_device] = glm::length(hand.session.snapshot().scope.tip_force);
    force[has_device] = glm::length(hand.session.snapshot().scope.hand_force);
  }
  EXPECT_NEAR(tip[0], 500 * 1.6e-3, 1e-3);
  EXPECT_NEAR(tip[1], 250 * 1.6e-3, 1e-3);
  EXPECT_NEAR(force[0], 0.8, 1e-3);
  EXPECT_NEAR(force[1], 0.3, 1e-9);
}

}  // namespace
}  // namespace arthro::simulation

#include "simulation/practice/scripted_device.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/practice/session.h"

namespace arthro::simulation {
namespace {

TEST(ScriptedDevice, SessionSeesThePoseThatWasSet) {
  LoadedScene loaded;
  Scene& scene = loaded.scene;
  scene.rig.instrument.portal_from_device = glm::normalize(glm::dquat(0.9, 0.1, -0.3, 0.2));
  scene.rig.instrument.pivot = {0.01, -0.02, 0.15};
  Session session(loaded);
  ScriptedDevice scope(session.scope_rig()), instrument(session.instrument_rig());
  scope.Set({0.1, -0.2, 0.5, 0.02});
  instrument.Set({-0.3, 0.4, 0.0, 0.03});
  session.Tick(scope.Sample(0.001), instrument.Sample(0.001), 0.001);
  EXPECT_NEAR(session.snapshot().scope.pose.latitude, 0.1, 1e-12);
  EXPECT_NEAR(session.snapshot().scope.pose.longitude, -0.2, 1e-12);
  EXPECT_NEAR(session.snapshot().scope.pose.roll, 0.5, 1e-12);
  EXPECT_NEAR(session.snapshot().instrument.pose.latitude, -0.3, 1e-12);
  EXPECT_NEAR(session.snapshot().instrument.pose.depth, 0.03, 1e-12);
}

TEST(ScriptedDevice, StaysWithinItsLimits) {
  DeviceRig rig;
  rig.rod_length = 0.1;
  ScriptedDevice device(rig);
  device.Set({5.0, -5.0, 9.0, 5.0});
  EXPECT_EQ(device.pose().latitude, RodLimits{}.max_latitude);
  EXPECT_EQ(device.pose().longitude, -RodLimits{}.max_longitude);
  EXPECT_EQ(device.pose().roll, 9.0) << "a hand may roll on";
  EXPECT_LT(device.pose().depth, rig.rod_length) << "the hand stays outside";
  device.Advance({0.0, 0.0, 0.0, -9.0});
  EXPECT_EQ(device.pose().depth, RodLimits{}.min_depth);
}

// A mouse moves once per frame; the hand of the servo must not jump by that motion.
TEST(ScriptedDevice, SpreadsTheMotionOfAFrameOverItsTicks) {
  DeviceRig rig;
  ScriptedDevice device(rig);
  device.Sample(0.0);
  device.Set({0.0, 0.0, 0.0, 0.016});
  glm::dvec3 last = device.Sample(0.0, 0.016).hip_in_device;
  for (int tick = 1; tick <= 16; ++tick) {
    const glm::dvec3 hip = device.Sample(tick * 0.001, (16 - tick) * 0.001).hip_in_device;
    EXPECT_NEAR(glm::length(hip - last), 0.001, 1e-9);
    last = hip;
  }
}

}  // namespace
}  // namespace arthro::simulation

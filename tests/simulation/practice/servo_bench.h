// Servo loop with two simulated force devices in a bare sphere, ticked on their clock.
#pragma once

#include "simulation/device/plant_device.h"
#include "simulation/practice/servo_loop.h"
#include "tests/simulation/practice/hand.h"

namespace arthro::simulation {

// Bare sphere of 80 mm.
inline LoadedScene BareSphere() {
  LoadedScene loaded = SceneOf({}, {});
  loaded.scene.tissues.clear();
  loaded.surfaces.clear();
  return loaded;
}

inline constexpr double kDepth = 1e-3;  // m, intended depth of both hands below the sphere

struct Servo {
  explicit Servo(const ServoOptions& options = {}, const PlantOptions& plant = {},
                 const HandModel& hand = kHand)
      : session(BareSphere()),
        scope(plant, hand, HipFromRodPose({0, 0, 0, 0.08 + kDepth}, session.scope_rig()), "a"),
        instrument(plant, hand, HipFromRodPose({0, 0, 0, 0.08 - 0.01}, session.instrument_rig()),
                   "b"),
        loop(session, &scope, &instrument, options) {
    request.options = session.options();
    request.view_angle = session.view_angle();
  }
  void HoldDeadMan(bool is_held) {
    request.is_dead_man_held = {is_held, is_held};
    loop.SetRequest(request);
  }
  const Snapshot& Tick(int ticks = 1, double dt = kTick) {
    for (int i = 0; i < ticks; ++i) loop.TickOnce(now += dt);
    return loop.ReadSnapshot();
  }
  // Opens, homes, arms and ramps.
  void Arm() {
    Tick(10);
    HoldDeadMan(true);
    Tick(1000);
  }
  Session session;
  PlantDevice scope, instrument;
  ServoLoop loop;
  ServoRequest request;
  double now = 0;
};

}  // namespace arthro::simulation

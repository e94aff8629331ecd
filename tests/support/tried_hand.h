// A simulated hand on a simulated device for tests of the first hour: its own clock, its dead-man,
// and events at given times. Device frame, m, N, s.
#pragma once

#include <functional>

#include "simulation/device/plant_device.h"
#include "simulation/practice/first_hour/force_trial.h"

namespace arthro::test {

struct TriedHand {
  simulation::PlantDevice device{{}, simulation::kHand, glm::dvec3(0.0)};
  double now = 0;
  bool is_held = true;
  std::function<void(double now)> event = [](double) {};  // before each tick

  // The dead-man is released for the first 50 ms of a trial, as a person takes it.
  simulation::TrialTicks Ticks() {
    const double begin = now;
    return {
        [this] {
          now += 0.001;
          event(now);
          return now;
        },
        [this, begin](const simulation::DeviceSample&) { return is_held && now > begin + 0.05; },
        [] { return false; }};
  }
};

}  // namespace arthro::test

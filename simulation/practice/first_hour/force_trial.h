// One force on the hand of a device, for the first hour with it [safety.md, First hour]. A trial
// waits until the device is armed and the hand has settled, gives the force through the limiter,
// measures how the hand moves and how the force ends, and leaves the device without force. Device
// frame, m, N, s.
#pragma once

#include <functional>

#include <glm/vec3.hpp>

#include "simulation/device/device.h"
#include "simulation/haptics/output/force_limiter.h"

namespace arthro::simulation {

struct ForceTrial {
  glm::dvec3 force{0.0};   // N, wanted; the limiter decides what is given
  LimiterOptions limiter;  // its max_force is that of the trial
  double seconds = 2;      // s, from the settled hand to the end
  double patience = 15;    // s, longest wait for the device to be armed
};

// Surroundings of a trial: its clock and who holds the dead-man.
struct TrialTicks {
  std::function<double()> next;  // waits for the next tick; its time on the clock of the device
  std::function<bool(const DeviceSample&)> is_held;  // the dead-man
  std::function<bool()> stops;                       // the program is to end
};

enum class TrialEnd {
  kDone,      // the whole time passed
  kNotReady,  // the device was never ready
  kNotArmed,  // nobody took the dead-man, or it was not released before
  kReleased,  // the dead-man was released
  kLost,      // the device was lost, or reported a fault
  kStopped,   // the program was ended
};

struct TrialReport {
  TrialEnd end = TrialEnd::kNotReady;
  double seconds = 0;     // s, after settling
  double rate = 0;        // Hz, new samples in that time
  double largest = 0;     // N, largest force that was commanded
  double steepest = 0;    // N/s, largest rise of the commanded force
  double silence = 0;     // s, kLost: age of the last sample when the force became zero
  glm::dvec3 moved{0.0};  // m, mean of the last fifth less the settled position
  double spread = 0;      // m, largest distance from the settled position
  DeviceStatus status;    // at the end
};

// Five zero forces are the last commands, however it ends.
TrialReport TryForce(Device& device, const ForceTrial& trial, const TrialTicks& ticks);

}  // namespace arthro::simulation

// One hand's device: where the hand is, and the force that it is given. Device frame, m, N, s. But
// for what never changes, one thread alone calls it, the servo, each tick in this order:
//   Read → HoldDeadMan → Command.
// None of them waits, locks or allocates.
#pragma once

#include <string>

#include "simulation/device/device_caps.h"
#include "simulation/device/device_sample.h"
#include "simulation/device/device_state.h"

namespace arthro::simulation {

class Device {
 public:
  Device() = default;
  virtual ~Device() = default;
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  // These never change, and may be read by any thread.
  virtual const DeviceCaps& caps() const noexcept = 0;
  virtual const std::string& name() const noexcept = 0;    // for a person
  virtual const std::string& serial() const noexcept = 0;  // which of several; roles follow it

  // The newest sample. `now` rises, on the clock of DeviceSample::t, so that now − t is its age;
  // not valid where there is none, or the device is lost or not homed. Advances the state.
  virtual DeviceSample Read(double now) noexcept = 0;
  // Whether somebody means to be pushed: a button of the handle, a pedal, a key. Counts from the
  // next Read on.
  virtual void HoldDeadMan(bool is_held) noexcept = 0;
  // The force on the hand from now on; zero unless the device may push (MayPush). What is not a
  // number is zero, and a fault.
  virtual void Command(const glm::dvec3& force_in_device) noexcept = 0;

  virtual DeviceStatus status() const noexcept = 0;
  DeviceState state() const noexcept { return status().state; }
};

}  // namespace arthro::simulation

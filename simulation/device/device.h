// Device of one hand: reports the position of the hand and gives it a force. Device frame, m, N, s.
// Except for the constants, only the servo thread calls it, each tick in this order:
//   Read → HoldDeadMan → Command.
// Implementations never wait, lock or allocate.
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

  // Constants, readable from any thread.
  virtual const DeviceCaps& caps() const noexcept = 0;
  virtual const std::string& name() const noexcept = 0;    // for the user
  virtual const std::string& serial() const noexcept = 0;  // identifies it; roles follow it

  // Returns the newest sample and advances the state. `now` must rise, on the clock of
  // DeviceSample::t, so that now − t is the age of the sample. The sample is not valid where there
  // is none, or the device is lost or not homed.
  virtual DeviceSample Read(double now) noexcept = 0;
  // Sets whether the dead-man is held: a button of the handle, a pedal or a key. Counts from the
  // next Read on.
  virtual void HoldDeadMan(bool is_held) noexcept = 0;
  // Sets the force on the hand; it is zero unless the device may push (MayPush). NaN gives zero and
  // a fault.
  virtual void Command(const glm::dvec3& force_in_device) noexcept = 0;

  virtual DeviceStatus status() const noexcept = 0;
  DeviceState state() const noexcept { return status().state; }
};

}  // namespace arthro::simulation

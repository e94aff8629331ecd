// Our side of one virtual arm: a live device over the real hidapi, ticked at 1 kHz as the servo
// does, and what each tick saw and gave.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "simulation/device/live/live_device.h"
#include "tests/support/temp_folder.h"

namespace arthro::test {

struct ServoTick {
  double now = 0, sample_t = 0;
  simulation::DeviceStatus status;
  bool is_valid = false;
  int counter = 0;  // base encoder, from the hand's position
  glm::dvec3 force{0.0};
};

class LiveArm {
 public:
  explicit LiveArm(const std::string& serial);

  // One tick that asks for `force`. Where `is_held`, the dead-man is held as somebody would who
  // wants to go on: let go when the device says that it must be.
  const ServoTick& Tick(const glm::dvec3& force, bool is_held);
  // Ticks until `is_over`, at most forty seconds of the guest's time. False: it never was.
  bool RunUntil(const glm::dvec3& force, bool is_held, const std::function<bool()>& is_over);
  void Run(const glm::dvec3& force, bool is_held, double seconds);
  // Homed, without force; and until it pushes.
  bool Home();
  bool Push(const glm::dvec3& force);

  simulation::LiveLink& link() { return *link_; }
  simulation::DeviceState state() const { return device_.state(); }
  const std::vector<ServoTick>& ticks() const { return ticks_; }

 private:
  TempFolder locks_;
  std::unique_ptr<simulation::HidBus> bus_ = simulation::MachineHidBus();
  std::shared_ptr<simulation::LiveLink> link_;
  simulation::LiveDevice device_;
  std::vector<ServoTick> ticks_;
};

}  // namespace arthro::test

// A HandPlant as a Device, for tests of a servo without hardware. Time is the argument of Read;
// faults are injected. Device frame, m, N, s.
#pragma once

#include "simulation/device/device.h"
#include "simulation/device/hand_plant.h"

namespace arthro::simulation {

class PlantDevice final : public Device {
 public:
  PlantDevice(const PlantOptions& options, const HandModel& hand, const glm::dvec3& at,
              std::string serial = "1");

  const DeviceCaps& caps() const noexcept override { return caps_; }
  const std::string& name() const noexcept override { return name_; }
  const std::string& serial() const noexcept override { return serial_; }
  // Advances the plant to `now` under the last command, then returns its sample.
  DeviceSample Read(double now) noexcept override;
  void HoldDeadMan(bool is_held) noexcept override { events_.is_dead_man_held = is_held; }
  void Command(const glm::dvec3& force_in_device) noexcept override;
  DeviceStatus status() const noexcept override { return status_; }

  HandPlant& plant() noexcept { return plant_; }
  // Injected events: unplugged and plugged in again, silent while it stays open, buttons.
  void SetPlugged(bool is_plugged) noexcept;
  void SetSilent(bool is_silent) noexcept { is_silent_ = is_silent; }
  void SetButtons(std::uint32_t buttons) noexcept { buttons_ = buttons; }
  // N, present force.
  const glm::dvec3& force() const noexcept { return force_; }

 private:
  DeviceCaps caps_;
  std::string name_ = "simulated device", serial_;
  HandPlant plant_;
  DeviceEvents events_;
  DeviceStatus status_;
  DeviceSample newest_;
  glm::dvec3 force_{0.0};
  std::uint32_t buttons_ = 0;
  bool has_time_ = false, is_silent_ = false;
  double now_ = 0;
};

}  // namespace arthro::simulation

// Hand of a plugged-in device, as the servo sees it.
#pragma once

#include "simulation/device/device.h"
#include "simulation/device/driver/rate_hand.h"
#include "simulation/device/live/live_link.h"

namespace arthro::simulation {

// Longest duration of writing a report; a longer one is a fault. The watchdog of the firmware is
// slower.
inline constexpr double kSlowWrite = 0.010;  // s

class LiveDevice final : public Device {
 public:
  // `link` is shared, since a device with two hands may hold two roles. An integrated hand begins
  // at `rest`.
  LiveDevice(std::shared_ptr<LiveLink> link, int hand, const RateHand& rest = {},
             const RateOptions& rate = {});

  const DeviceCaps& caps() const noexcept override { return link_->caps(); }
  const std::string& name() const noexcept override { return name_; }
  const std::string& serial() const noexcept override { return link_->request().serial; }
  // `now` is on the clock of the link: SteadySeconds() except in tests.
  DeviceSample Read(double now) noexcept override;
  void HoldDeadMan(bool is_held) noexcept override { events_.is_dead_man_held = is_held; }
  void Command(const glm::dvec3& force_in_device) noexcept override;
  DeviceStatus status() const noexcept override { return status_; }

  // Sets an integrated hand; call between ticks.
  void SetRateHand(const RateHand& at) noexcept { rate_hand_ = at; }

  LiveLink& link() noexcept { return *link_; }
  // N, force that was sent last.
  const glm::dvec3& force() const noexcept { return force_; }

 private:
  std::shared_ptr<LiveLink> link_;
  int hand_;
  std::string name_;
  RateHand rate_hand_;
  RateOptions rate_;
  DeviceEvents events_;
  DeviceStatus status_;
  glm::dvec3 joints_{0.0}, force_{0.0};
  bool is_not_finite_ = false, has_time_ = false;
  double now_ = 0;
};

}  // namespace arthro::simulation

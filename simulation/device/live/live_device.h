// One hand of a plugged-in device, as the servo sees it.
#pragma once

#include "simulation/device/device.h"
#include "simulation/device/driver/rate_hand.h"
#include "simulation/device/live/live_link.h"

namespace arthro::simulation {

// A report that takes longer to be taken is a fault. The firmware's own watchdog is slower.
inline constexpr double kSlowWrite = 0.010;  // s

class LiveDevice final : public Device {
 public:
  // `link` is shared because one device may have two hands, which two roles hold. Where the hand is
  // integrated it begins at `rest`.
  LiveDevice(std::shared_ptr<LiveLink> link, int hand, const RateHand& rest = {},
             const RateOptions& rate = {});

  const DeviceCaps& caps() const noexcept override { return link_->caps(); }
  const std::string& name() const noexcept override { return name_; }
  const std::string& serial() const noexcept override { return link_->request().serial; }
  // `now` is the link's clock: SteadySeconds() but for tests.
  DeviceSample Read(double now) noexcept override;
  void HoldDeadMan(bool is_held) noexcept override { events_.is_dead_man_held = is_held; }
  void Command(const glm::dvec3& force_in_device) noexcept override;
  DeviceStatus status() const noexcept override { return status_; }

  // Between ticks: an integrated hand goes on from there.
  void SetRateHand(const RateHand& at) noexcept { rate_hand_ = at; }

  LiveLink& link() noexcept { return *link_; }
  // N, as it was sent last.
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

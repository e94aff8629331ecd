#include "simulation/device/log/logged_device.h"

#include <algorithm>
#include <cmath>

namespace arthro::simulation {
namespace {

std::int64_t Nanoseconds(double t) noexcept {
  return static_cast<std::int64_t>(std::llround(1e9 * t));
}

}  // namespace

LoggedDevice::LoggedDevice(std::unique_ptr<Device> device, DeviceLog& log, int source, int hand)
    : device_(std::move(device)), channel_(log.AddChannel()) {
  tick_.kind = LogKind::kTick;
  tick_.source = static_cast<std::uint8_t>(source);
  tick_.tick_hand = static_cast<std::uint8_t>(hand);
}

DeviceSample LoggedDevice::Read(double now) noexcept {
  tick_.sample = device_->Read(now);
  tick_.t_ns = Nanoseconds(now);
  return tick_.sample;
}

void LoggedDevice::HoldDeadMan(bool is_held) noexcept {
  device_->HoldDeadMan(is_held);
  tick_.is_dead_man_held = is_held;
}

void LoggedDevice::Command(const glm::dvec3& force_in_device) noexcept {
  device_->Command(force_in_device);
  tick_.command = force_in_device;
  tick_.status = device_->status();
  channel_.Push(tick_);
}

LoggedReports::LoggedReports(DeviceLog& log, int source) : channel_(log.AddChannel()) {
  record_.source = static_cast<std::uint8_t>(source);
}

void LoggedReports::Opened(double t, const HidNode& node) noexcept {
  record_.kind = LogKind::kOpened;
  record_.t_ns = Nanoseconds(t);
  record_.vendor = node.vendor;
  record_.is_bluetooth = node.is_bluetooth;
  channel_.Push(record_);
}

void LoggedReports::HomeAsked(double t) noexcept {
  record_.kind = LogKind::kHomeAsked;
  record_.t_ns = Nanoseconds(t);
  channel_.Push(record_);
}

void LoggedReports::Took(double t, ReportBytes report, ReportNews news,
                         const DeviceDriver& driver) noexcept {
  record_.kind = LogKind::kReport;
  record_.t_ns = Nanoseconds(t);
  record_.news = news;
  const std::size_t size = std::min(report.size(), record_.bytes.size());
  record_.size = static_cast<std::uint8_t>(size);
  std::copy_n(report.begin(), size, record_.bytes.begin());
  record_.hands = static_cast<std::uint8_t>(driver.hands());
  for (int hand = 0; hand < driver.hands(); ++hand)
    record_.hand[static_cast<std::size_t>(hand)] = LoggedHandOf(driver.Hand(hand));
  channel_.Push(record_);
}

}  // namespace arthro::simulation

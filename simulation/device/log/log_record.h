// What a device log holds: who was plugged in, each report as it came with what the driver made of
// it, each tick of the servo with what was commanded [devices.md, Simulated hand]. Device frame, m,
// N, s; times on the clock of live devices.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "simulation/device/device_sample.h"
#include "simulation/device/device_state.h"
#include "simulation/device/driver/device_driver.h"
#include "simulation/device/hid/hid_link.h"

namespace arthro::simulation {

// One plugged-in device, or one that is computed.
struct LogSource {
  std::string family;  // word of DeviceFamily; empty: it has no reports
  std::string model;   // of a WoodenHaptics
  std::string serial;
  std::array<std::optional<DeviceRole>, 2> roles;  // of its hands
  friend bool operator==(const LogSource&, const LogSource&) = default;
};

enum class LogKind : std::uint8_t {
  kOpened = 1,  // the driver forgot what it knew
  kHomeAsked,
  kReport,
  kTick,
  kEnd,  // the last one, of the log itself
};

// A hand as the driver said it after a report. Of what the servo does not see (joints, push and
// turn) only a checksum.
struct LoggedHand {
  DeviceSample sample;  // no time: a driver knows none
  bool is_homed = false;
  std::uint32_t rest = 0;
};
LoggedHand LoggedHandOf(const HandReading& reading) noexcept;
// To the bit; of two that are not numbers, too.
bool IsSame(const LoggedHand& a, const LoggedHand& b) noexcept;

struct LogRecord {
  LogKind kind = LogKind::kTick;
  std::uint8_t source = 0;
  std::int64_t t_ns = 0;
  std::uint64_t number = 0;  // of its channel, from 0; where some are missing, they were dropped

  // kOpened
  std::uint16_t vendor = 0;
  bool is_bluetooth = false;

  // kReport
  ReportNews news = ReportNews::kIgnored;
  std::uint8_t size = 0, hands = 0;
  std::array<std::uint8_t, kReportRoom> bytes{};
  std::array<LoggedHand, 2> hand;

  // kTick
  std::uint8_t tick_hand = 0;
  DeviceSample sample;
  glm::dvec3 command{0.0};
  DeviceStatus status;
  bool is_dead_man_held = false;

  // kEnd
  std::uint64_t pushed = 0;  // records of all channels, those that were dropped included
};

}  // namespace arthro::simulation

// Records of a device log: the sources, each report with the state that the driver decoded from it,
// each tick of the servo with its command, and each wish of the trainee [devices.md, Simulated
// hand]. Device frame, m, N, s; times on the clock of live devices.
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

// A plugged-in device, or a simulated one.
struct LogSource {
  std::string family;  // text of DeviceFamily; empty: it has no reports
  std::string model;   // WoodenHaptics only
  std::string serial;
  std::array<std::optional<DeviceRole>, 2> roles;  // roles of its hands
  friend bool operator==(const LogSource&, const LogSource&) = default;
};

enum class LogKind : std::uint8_t {
  kOpened = 1,  // the driver forgot its state
  kHomeAsked,
  kReport,
  kTick,
  kEnd,  // last record, of the log itself
  kWish,
  kOption,
  // Records of an attempt, whose bytes this folder does not interpret (training/attempt_log.h).
  kAttempt,
  kFrame,
  kEvent,
  kPiece,  // piece of tissue, which has a block of its own
};

// State of a hand after a report. Joints, push and turn, which the servo does not see, are kept as
// a checksum only.
struct LoggedHand {
  DeviceSample sample;  // without a time, which a driver does not know
  bool is_homed = false;
  std::uint32_t rest = 0;
};
LoggedHand LoggedHandOf(const HandReading& reading) noexcept;
// Compares bit by bit, NaN included.
bool IsSame(const LoggedHand& a, const LoggedHand& b) noexcept;

// Mount of a device at its portal, and the rod on it.
struct LoggedMount {
  glm::dvec3 pivot{0.0};  // m, device frame
  glm::dquat portal_from_device{1.0, 0.0, 0.0, 0.0};
  double rod_length = 0;  // m
  friend bool operator==(const LoggedMount&, const LoggedMount&) = default;
};

// Option of the session by its name; logged when it changes.
struct LoggedOption {
  std::array<char, 40> name{};  // ends with a zero
  double value = 0;             // in the unit of memory; 1 and 0 for yes and no
  friend bool operator==(const LoggedOption&, const LoggedOption&) = default;
};

// State of a practice that its hands do not tell; logged when it changes.
struct LoggedWish {
  double view_angle = 0, incision_spacing = 0;  // rad, m
  std::uint8_t instrument = 0;                  // number of its kind (ToolKind)
  std::uint32_t resets = 0;                     // times that the tissue was made whole again
  // False for a log of version 3, which has none of the following.
  bool is_complete = false;
  bool is_head_upright = false;         // camera head
  double head_turn = 0;                 // rad
  std::array<double, 7> disturbance{};  // strengths, in their order
  std::int32_t disturbance_seed = 0;
  std::array<LoggedMount, 2> mount{};  // indexed by DeviceRole
  friend bool operator==(const LoggedWish&, const LoggedWish&) = default;
};

struct LogRecord {
  LogKind kind = LogKind::kTick;
  std::uint8_t source = 0;
  std::int64_t t_ns = 0;
  std::uint64_t number = 0;  // number in its channel, from 0; missing numbers were dropped

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
  std::uint64_t pushed = 0;  // records of all channels, dropped ones included

  // kWish
  LoggedWish wish;

  // kOption
  LoggedOption option;
};

}  // namespace arthro::simulation

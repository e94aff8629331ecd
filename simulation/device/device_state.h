// State of a device and its reason [method.md, Output chain]:
//   absent → opening → homing → ready (no force) → armed; fault and lost on the way, both without
//   force.
// Arming needs a fresh sample, and a dead-man that was released since the device became ready.
// Pure: the same events give the same states. s.
#pragma once

namespace arthro::simulation {

enum class DeviceState { kAbsent, kOpening, kHoming, kReady, kArmed, kFault, kLost };

enum class DeviceTrouble {
  kNone,
  kNoPermission,   // its node exists and may not be opened
  kHeldElsewhere,  // another program uses it
  kUnsupported,    // a variant that this program must not drive
  kNotFinite,      // it was commanded a force that is NaN
  kSlowWrite,      // a report took too long to be written
  kReadError,      // usually unplugged
  kWriteError,
  kSilent,     // no sample for longer than kLostAfter
  kProtected,  // it stopped itself: warm motors, or too much force or speed
};

// Age limits of a sample. From kFreshFor on it gets no force, so with a tick of 1 ms none is given
// 6 ms after the last sample. After kLostAfter the device is lost.
inline constexpr double kFreshFor = 0.005, kLostAfter = 0.020;  // s; 5 and 20 missed reports
inline constexpr double kClockGrain = 1e-6;  // s, upper bound of the rounding error of summed ticks

struct DeviceEvents {
  bool is_present = false;  // the device is listed
  bool is_open = false;     // this program has it open
  bool is_homed = false;    // its counters are set; true at once for a device without homing
  bool has_sample = false;  // since it was opened
  double sample_age = 0;    // s
  bool is_dead_man_held = false;
  DeviceTrouble trouble = DeviceTrouble::kNone;  // now
};

struct DeviceStatus {
  DeviceState state = DeviceState::kAbsent;
  DeviceTrouble reason = DeviceTrouble::kNone;  // reason of kFault and kLost
  bool must_release = true;                     // the dead-man must be released before arming
  friend bool operator==(const DeviceStatus&, const DeviceStatus&) = default;
};

// Ready or armed: the device says where the hand is.
constexpr bool IsReady(DeviceState state) noexcept {
  return state == DeviceState::kReady || state == DeviceState::kArmed;
}

DeviceStatus Next(const DeviceStatus& status, const DeviceEvents& events) noexcept;

// Returns true where the device is armed, without trouble, and its sample is fresh.
bool MayPush(const DeviceStatus& status, const DeviceEvents& events) noexcept;

// One word, and a sentence for the user: the cause and what to do.
const char* ToString(DeviceState state) noexcept;
const char* DescribeStatus(const DeviceStatus& status) noexcept;

}  // namespace arthro::simulation

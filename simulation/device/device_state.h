// In which state a device is, and why [method.md, Output chain]:
//   absent → opening → homing → ready (no force) → armed; fault and lost on the way, both without
//   force.
// Arming needs a fresh sample and a dead-man that was seen released since the device last was not
// ready. Pure: the same events give the same states. s.
#pragma once

namespace arthro::simulation {

enum class DeviceState { kAbsent, kOpening, kHoming, kReady, kArmed, kFault, kLost };

enum class DeviceTrouble {
  kNone,
  kNoPermission,   // its node is there, and may not be opened
  kHeldElsewhere,  // another program has it
  kUnsupported,    // a variant that we must not drive
  kNotFinite,      // it was commanded a force that is not a number
  kSlowWrite,      // a report took too long to be taken
  kReadError,      // unplugged, as a rule
  kWriteError,
  kSilent,     // no sample for longer than kLostAfter
  kProtected,  // it stopped itself: warm motors, too much force or speed
};

// A sample of that age gets no force any more, so that with a tick of 1 ms none is given 6 ms after
// the last one; with no newer one for longer than the second a device is lost.
inline constexpr double kFreshFor = 0.005, kLostAfter = 0.020;  // s; 5 and 20 missed reports
inline constexpr double kClockGrain = 1e-6;  // s; ticks that add up to an age are off by less

struct DeviceEvents {
  bool is_present = false;  // it is listed
  bool is_open = false;     // and we hold it
  bool is_homed = false;    // its counters are set; at once where it needs none
  bool has_sample = false;  // since it was opened
  double sample_age = 0;    // s
  bool is_dead_man_held = false;
  DeviceTrouble trouble = DeviceTrouble::kNone;  // now
};

struct DeviceStatus {
  DeviceState state = DeviceState::kAbsent;
  DeviceTrouble reason = DeviceTrouble::kNone;  // of kFault and kLost
  bool must_release = true;                     // the dead-man, before it arms
  friend bool operator==(const DeviceStatus&, const DeviceStatus&) = default;
};

// Ready or armed: the device says where the hand is.
constexpr bool IsReady(DeviceState state) noexcept {
  return state == DeviceState::kReady || state == DeviceState::kArmed;
}

DeviceStatus Next(const DeviceStatus& status, const DeviceEvents& events) noexcept;

// Armed, with nothing wrong, and the hand is where the sample says.
bool MayPush(const DeviceStatus& status, const DeviceEvents& events) noexcept;

// One word, and a sentence for a person: what is the matter and what to do.
const char* ToString(DeviceState state) noexcept;
const char* DescribeStatus(const DeviceStatus& status) noexcept;

}  // namespace arthro::simulation

#include "simulation/device/device_state.h"

namespace arthro::simulation {
namespace {

bool IsFresh(const DeviceEvents& events) noexcept {
  // A NaN age is not fresh.
  return events.has_sample && events.sample_age >= 0 && events.sample_age < kFreshFor - kClockGrain;
}

// Distinguishes faults, of the command or the device itself, from losses of the link.
bool IsFault(DeviceTrouble trouble) noexcept {
  return trouble != DeviceTrouble::kNone &&
         (trouble < DeviceTrouble::kReadError || trouble == DeviceTrouble::kProtected);
}

DeviceStatus Running(const DeviceStatus& status, const DeviceEvents& events) noexcept {
  using enum DeviceState;
  if (events.trouble != DeviceTrouble::kNone)
    return {IsFault(events.trouble) ? kFault : kLost, events.trouble, true};
  if (!events.is_present || !events.is_open) return {kLost, DeviceTrouble::kReadError, true};
  if (!events.is_homed) return {kHoming, {}, true};
  if (!events.has_sample || !(events.sample_age <= kLostAfter))
    return {kLost, DeviceTrouble::kSilent, true};
  const bool must_release = status.must_release && events.is_dead_man_held;
  const bool may_arm = events.is_dead_man_held && !must_release;
  // An armed device stays armed with a slightly late sample, which only pauses the force.
  if (may_arm && (status.state == kArmed || IsFresh(events))) return {kArmed, {}, false};
  return {kReady, {}, must_release};
}

}  // namespace

DeviceStatus Next(const DeviceStatus& status, const DeviceEvents& events) noexcept {
  using enum DeviceState;
  switch (status.state) {
    case kAbsent:
      return {events.is_present ? kOpening : kAbsent, {}, true};
    case kOpening:
      if (IsFault(events.trouble)) return {kFault, events.trouble, true};
      if (!events.is_present || events.trouble != DeviceTrouble::kNone) return {kAbsent, {}, true};
      return {events.is_open ? kHoming : kOpening, {}, true};
    case kHoming:
      if (events.trouble != DeviceTrouble::kNone || !events.is_present || !events.is_open)
        return Running(status, events);
      return {events.is_homed && IsFresh(events) ? kReady : kHoming, {}, events.is_dead_man_held};
    case kReady:
    case kArmed:
      return Running(status, events);
    case kFault:
    case kLost: {
      const bool is_over = events.trouble == DeviceTrouble::kNone;
      if (!is_over) {
        // Keeps the first reason, unless the link is lost.
        const bool is_lost_now = status.state == kFault && !IsFault(events.trouble);
        return is_lost_now ? DeviceStatus{kLost, events.trouble, true}
                           : DeviceStatus{status.state, status.reason, true};
      }
      if (!events.is_present) return {kAbsent, {}, true};
      // A fault ends when the dead-man is released, a loss when the device reports again.
      if (status.state == kFault && events.is_dead_man_held) return {kFault, status.reason, true};
      if (!events.is_open) return {kOpening, {}, true};
      if (status.state == kLost && !IsFresh(events)) return {kLost, status.reason, true};
      return {kHoming, {}, true};
    }
  }
  return {};
}

bool MayPush(const DeviceStatus& status, const DeviceEvents& events) noexcept {
  return status.state == DeviceState::kArmed && events.is_dead_man_held && events.is_present &&
         events.is_open && events.is_homed && events.trouble == DeviceTrouble::kNone &&
         IsFresh(events);
}

const char* ToString(DeviceState state) noexcept {
  switch (state) {
    case DeviceState::kAbsent:
      return "absent";
    case DeviceState::kOpening:
      return "opening";
    case DeviceState::kHoming:
      return "homing";
    case DeviceState::kReady:
      return "ready";
    case DeviceState::kArmed:
      return "armed";
    case DeviceState::kFault:
      return "fault";
    case DeviceState::kLost:
      return "lost";
  }
  return "absent";
}

const char* DescribeStatus(const DeviceStatus& status) noexcept {
  switch (status.state) {
    case DeviceState::kAbsent:
      return "not connected; plug it in";
    case DeviceState::kOpening:
      return "found, being opened";
    case DeviceState::kHoming:
      return "waiting for its position; put the handle into its rest and press its button";
    case DeviceState::kReady:
      return status.must_release ? "ready; let go of the dead-man first" : "ready, without force";
    case DeviceState::kArmed:
      return "armed: it pushes";
    case DeviceState::kFault:
    case DeviceState::kLost:
      break;
  }
  switch (status.reason) {
    case DeviceTrouble::kNoPermission:
      return "it may not be opened; install the rule 70-arthroscene.rules in /etc/udev/rules.d and "
             "plug it in again";
    case DeviceTrouble::kHeldElsewhere:
      return "another program uses it; close that one";
    case DeviceTrouble::kUnsupported:
      return "a variant whose geometry is not known here; it is not driven";
    case DeviceTrouble::kNotFinite:
      return "it was given a force that is no number; let go of the dead-man to go on";
    case DeviceTrouble::kSlowWrite:
      return "it takes its forces too slowly; let go of the dead-man, and use another USB port";
    case DeviceTrouble::kReadError:
    case DeviceTrouble::kWriteError:
      return "it was unplugged or has failed; plug it in again";
    case DeviceTrouble::kSilent:
      return "it is connected and says nothing; check its power, or plug it in again";
    case DeviceTrouble::kProtected:
      return "it stopped itself, since it was pushed too hard or its motors are warm; let go of "
             "the "
             "dead-man, and give it a rest";
    case DeviceTrouble::kNone:
      break;
  }
  return "it has failed; plug it in again";
}

}  // namespace arthro::simulation

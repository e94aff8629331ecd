#include "simulation/practice/hands/why_no_force.h"

namespace arthro::simulation {

const char* WhyNoForce(const ForceSituation& situation) noexcept {
  // Reasons in the hardware.
  if (situation.kind == HandKind::kMouse)
    return "No device holds this hand: mouse and keys do. Rig in the step Practice, or --rig, "
           "names one.";
  if (situation.kind == HandKind::kRecorded)
    return "A recording holds this hand; nobody is there to be pushed.";
  switch (situation.status.state) {
    case DeviceState::kAbsent:
      return "The device is not connected; plug it in.";
    case DeviceState::kOpening:
      return "The device was found and is being opened.";
    case DeviceState::kHoming:
      return "The device does not know where it is; put its handle into its rest and press its "
             "button.";
    case DeviceState::kFault:
    case DeviceState::kLost:
      return DescribeStatus(situation.status);
    case DeviceState::kReady:
    case DeviceState::kArmed:
      break;
  }
  if (situation.caps.feedback == Feedback::kRumble) return "This device rumbles and cannot push.";
  if (!HasForce(situation.caps))
    return "This device has no motors; it only says where the hand is.";
  // Reasons in the modes.
  if (situation.is_zero_force)
    return "Zero-force mode is on: the force is shown and none is given. 0 ends it.";
  if (situation.is_calibrating)
    return "An incision is being calibrated; no device pushes until that is closed.";
  if (!situation.is_practising) return "Devices push only in a practice; F5 begins one.";
  // Reasons in the samples and the dead-man. A sample age that is NaN is not fresh.
  if (!(situation.sample_age <= kLostAfter))
    return "The device has said nothing for more than 20 ms; check its cable.";
  if (!(situation.sample_age < kFreshFor))
    return "Its last sample is older than 5 ms; the force waits for a fresh one.";
  if (situation.status.state == DeviceState::kReady) {
    if (!situation.is_dead_man_held)
      return "Nobody holds the dead-man: hold the handle's button, the pedal or V.";
    return situation.status.must_release
               ? "The dead-man was held too early; let go of it and hold it again."
               : "The device is about to be armed.";
  }
  if (!situation.is_dead_man_held)
    return "Nobody holds the dead-man: hold the handle's button, the pedal or V.";
  // Reasons in the session.
  switch (situation.fault) {
    case Fault::kTooFast:
      return "The hand is too fast; slow down.";
    case Fault::kTissue:
      return "The tissue was reset; the force comes back with its next step.";
    case Fault::kNoSample:
    case Fault::kStale:
    case Fault::kLost:
      return "The session has no fresh position of this hand.";
    case Fault::kTooFar:
      return "The device says that the hand is metres away; home it again.";
    case Fault::kNotFinite:
      return "A position or a force was no number; let go of the dead-man and hold it again.";
    default:
      break;
  }
  return situation.has_force ? "" : "Nothing is touched.";
}

}  // namespace arthro::simulation

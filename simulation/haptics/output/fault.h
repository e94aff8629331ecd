// Reason why a device is given no force. A fault is a value in the snapshot, since the servo path
// neither throws nor logs [method.md, Threads].
#pragma once

namespace arthro::simulation {

enum class Fault {
  kNone,
  kNoSample,   // the device is absent or its sample is not valid
  kStale,      // the same sample for longer than max_sample_age
  kLost,       // the same sample for longer than lost_after
  kNotFinite,  // a position or a force that is not a number
  kTooFar,     // the hand is further from its incision than any rod reaches
  kTooFast,    // the hand is faster than max_hand_speed
  kNotArmed,   // nobody holds the dead-man of the device
  kTissue,     // a tissue could not be computed and was reset
};

// Text in forces.csv.
constexpr const char* ToString(Fault fault) noexcept {
  switch (fault) {
    case Fault::kNone:
      return "none";
    case Fault::kNoSample:
      return "no_sample";
    case Fault::kStale:
      return "stale";
    case Fault::kLost:
      return "lost";
    case Fault::kNotFinite:
      return "not_finite";
    case Fault::kTooFar:
      return "too_far";
    case Fault::kTooFast:
      return "too_fast";
    case Fault::kNotArmed:
      return "not_armed";
    case Fault::kTissue:
      return "tissue";
  }
  return "none";
}

}  // namespace arthro::simulation

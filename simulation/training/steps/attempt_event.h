// Events of an attempt: what the step engine found, and what trainee and instructor did. s after
// the begin of the attempt.
#pragma once

#include <string>

namespace arthro::simulation {

enum class EventKind {
  kAttemptStart,
  kAttemptEnd,
  kStepStart,
  kStepDone,
  kStepFailed,
  kCue,
  kSeen,
  kLost,
  kProbed,
  kForceOver,
  kZoneIn,
  kZoneOut,
  kMark,
  kAnswer,
  kGrasp,
  kDrop,
  kPlaced,
  kBite,
  kCutOutside,
  kBleed,
  kStopped,
  kReset,
  kPause,
  kResume,
  kLookDown,
  kNote,
  kFault,
};

struct AttemptEvent {
  double t = 0;
  EventKind kind = EventKind::kNote;
  std::string step, target;  // ids in the exercise; empty where it has none
  double value = 0;          // N for forces, m³ for volumes, index of the answer; else 0
  std::string note;
  friend bool operator==(const AttemptEvent&, const AttemptEvent&) = default;
};

}  // namespace arthro::simulation

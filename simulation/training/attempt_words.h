// Words for the kinds of an attempt's outcome, steps and events, as records and reports have them.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "simulation/training/attempt_result.h"

namespace arthro::simulation {

inline const char* ToString(AttemptOutcome outcome) {
  constexpr std::array kWords = {"running", "passed", "failed", "stopped", "void"};
  return kWords[static_cast<std::size_t>(outcome)];
}

inline const char* ToString(StepOutcome outcome) {
  constexpr std::array kWords = {"pending", "running", "done", "failed"};
  return kWords[static_cast<std::size_t>(outcome)];
}

inline const char* ToString(EventKind kind) {
  constexpr std::array kWords = {
      "attempt_start", "attempt_end", "step_start", "step_done", "step_failed", "cue",   "seen",
      "lost",          "probed",      "force_over", "zone_in",   "zone_out",    "mark",  "answer",
      "grasp",         "drop",        "placed",     "bite",      "cut_outside", "bleed", "stopped",
      "reset",         "pause",       "resume",     "look_down", "note",        "fault"};
  static_assert(kWords.size() == static_cast<std::size_t>(EventKind::kFault) + 1);
  return kWords[static_cast<std::size_t>(kind)];
}

// The kind that has this word; nothing where none has.
template <class Kind, Kind last>
std::optional<Kind> KindOfWord(std::string_view word) {
  for (int i = 0; i <= static_cast<int>(last); ++i)
    if (word == ToString(static_cast<Kind>(i))) return static_cast<Kind>(i);
  return std::nullopt;
}
inline std::optional<StepOutcome> StepOutcomeFromString(std::string_view word) {
  return KindOfWord<StepOutcome, StepOutcome::kFailed>(word);
}
inline std::optional<EventKind> EventKindFromString(std::string_view word) {
  return KindOfWord<EventKind, EventKind::kFault>(word);
}

}  // namespace arthro::simulation

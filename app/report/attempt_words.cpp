#include "app/report/attempt_words.h"

#include <algorithm>

#include <fmt/format.h>

#include "simulation/training/attempt_words.h"
#include "simulation/training/metrics/metrics.h"

namespace arthro::app {
std::string UnitOf(const AttemptRecord& attempt, const std::string& metric,
                   const std::string& part) {
  for (const MetricRow& row : attempt.metrics)
    if (row.name == metric && (row.part == part || part.empty())) return row.unit;
  return "";
}

std::string OutcomeWords(const AttemptRecord& attempt) {
  const auto with = [&](const char* words) {
    return attempt.reason.empty() ? words + std::string(".")
                                  : fmt::format("{}. {}", words, attempt.reason);
  };
  switch (attempt.outcome) {
    case AttemptOutcome::kPassed:
      return with(attempt.criteria.empty() ? "Done; this exercise has no criteria"
                                           : "Passed: every criterion is met");
    case AttemptOutcome::kFailed:
      return with("Not passed");
    case AttemptOutcome::kStopped:
      return with("Stopped");
    case AttemptOutcome::kVoid:
      return with("Void: it does not count");
    case AttemptOutcome::kRunning:
      return with("Running");
  }
  return "";
}

std::string TimeWords(const std::string& utc) {
  std::string words = utc.substr(0, 16);  // "2026-11-24T02:10"
  std::ranges::replace(words, 'T', ' ');
  return words;
}

const char* EventWords(simulation::EventKind kind) {
  using simulation::EventKind;
  switch (kind) {
    case EventKind::kAttemptStart:
      return "Begin";
    case EventKind::kAttemptEnd:
      return "End";
    case EventKind::kStepStart:
      return "Step begins";
    case EventKind::kStepDone:
      return "Step done";
    case EventKind::kStepFailed:
      return "Step failed";
    case EventKind::kCue:
      return "Hint";
    case EventKind::kSeen:
      return "Seen";
    case EventKind::kLost:
      return "Lost";
    case EventKind::kProbed:
      return "Probed";
    case EventKind::kForceOver:
      return "Too much force";
    case EventKind::kZoneIn:
      return "Zone entered";
    case EventKind::kZoneOut:
      return "Zone left";
    case EventKind::kMark:
      return "Mark";
    case EventKind::kAnswer:
      return "Answer";
    case EventKind::kGrasp:
      return "Grasped";
    case EventKind::kDrop:
      return "Dropped";
    case EventKind::kPlaced:
      return "Placed";
    case EventKind::kBite:
      return "Bite";
    case EventKind::kCutOutside:
      return "Cut outside";
    case EventKind::kBleed:
      return "Bleeding";
    case EventKind::kStopped:
      return "Stopped";
    case EventKind::kReset:
      return "Tissue restored";
    case EventKind::kPause:
      return "Pause";
    case EventKind::kResume:
      return "Resumed";
    case EventKind::kLookDown:
      return "Looked down";
    case EventKind::kNote:
      return "Note";
    case EventKind::kFault:
      return "Fault";
  }
  return "";
}

std::string EventWords(const std::string& kind) {
  if (const auto known = simulation::EventKindFromString(kind)) return EventWords(*known);
  std::string words = kind;
  std::ranges::replace(words, '_', ' ');
  return words;
}

const char* BetterWord(const std::string& metric) {
  for (const simulation::Metric& known : simulation::EveryMetric())
    if (known.id == metric) return known.is_more_better ? "more" : "less";
  return "";
}

}  // namespace arthro::app

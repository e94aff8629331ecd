#include "simulation/training/score/recorded_result.h"

#include <cmath>

#include "simulation/training/metrics/exercise_metrics.h"

namespace arthro::simulation {
namespace {

// The act behind an event; nothing for events that the engine finds by itself.
std::optional<TraineeAct> ActOf(const AttemptEvent& event) {
  switch (event.kind) {
    case EventKind::kMark:
      return TraineeAct{ActKind::kMark, 0, ""};
    case EventKind::kAnswer:
      return TraineeAct{ActKind::kAnswer, static_cast<int>(event.value), ""};
    case EventKind::kCue:
      if (event.note != kAskedFor) return std::nullopt;
      return TraineeAct{ActKind::kHint, 0, ""};
    case EventKind::kReset:
      return TraineeAct{ActKind::kReset, 0, event.note};
    case EventKind::kLookDown:
      return TraineeAct{ActKind::kLookDown, 0, event.note};
    case EventKind::kNote:
      return TraineeAct{ActKind::kNote, 0, event.note};
    case EventKind::kStopped:
      if (event.note == kRecordingEnds) return std::nullopt;
      return TraineeAct{ActKind::kStop, 0, event.note};
    default:
      return std::nullopt;
  }
}

}  // namespace

std::vector<std::vector<TraineeAct>> ActsOf(std::span<const AttemptEvent> events,
                                            std::size_t frames) {
  std::vector<std::vector<TraineeAct>> acts(frames);
  for (const AttemptEvent& event : events) {
    const auto act = ActOf(event);
    // Frame k ends at (k + 1) · 10 ms.
    const long frame = std::lround(event.t / kFrameTime) - 1;
    if (act && frame >= 0 && frame < static_cast<long>(frames))
      acts[static_cast<std::size_t>(frame)].push_back(*act);
  }
  return acts;
}

StepEngine EngineOfRecording(const RecordedAttempt& recording, const Exercise& exercise,
                             const MetricLimits& limits) {
  StepEngine engine(exercise, limits.harm);
  AdvanceAll(engine, recording.frames, ActsOf(recording.events, recording.frames.size()));
  engine.Finish();
  return engine;
}

AttemptResult ResultOfRecording(const RecordedAttempt& recording, const Exercise& exercise,
                                const std::vector<std::string>& surfaces,
                                std::span<const GroupValues> groups, const MetricLimits& limits,
                                const GhostPath* ghost) {
  const StepEngine engine = EngineOfRecording(recording, exercise, limits);
  return ResultOf(engine, MeasureExercise(recording.frames, engine, surfaces, limits, ghost),
                  groups);
}

}  // namespace arthro::simulation

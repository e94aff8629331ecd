#include "simulation/training/assessment.h"

#include "simulation/training/observe/frame_builder.h"
#include "simulation/training/observe/surface_names.h"

namespace arthro::simulation {
Assessment AssessFrames(std::span<const AttemptFrame> frames, const Scene& scene,
                        const MetricLimits& limits) {
  Assessment assessment;
  assessment.duration = kFrameTime * static_cast<double>(frames.size());
  assessment.frames.assign(frames.begin(), frames.end());
  assessment.values = MeasureAttempt(frames, SurfaceNames(scene), limits);
  return assessment;
}

Assessment Assess(const LoadedScene& loaded, const Recording& recording,
                  const SessionOptions& options, const MetricLimits& limits,
                  const Progress& progress, const std::vector<TissuePreset>& presets,
                  std::vector<std::string>* messages) {
  Assessment assessment;
  if (recording.rows.empty()) return assessment;
  FrameBuilder builder(recording.rows.front().sample.t);
  ReplayReport replay;
  Replay(
      loaded, recording, options, progress, &replay, presets,
      [&](double t, const Snapshot& snapshot, const WorldPicture*) { builder.Add(t, snapshot); });
  builder.Finish();
  if (messages != nullptr) *messages = replay.messages;
  assessment = AssessFrames(builder.frames(), loaded.scene, limits);
  assessment.duration = replay.duration;
  return assessment;
}

}  // namespace arthro::simulation

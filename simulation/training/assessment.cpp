#include "simulation/training/assessment.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "simulation/core/csv_field.h"
#include "simulation/training/observe/frame_builder.h"
#include "simulation/training/observe/surface_names.h"

namespace arthro::simulation {
namespace {

const char* Better(const Metric& metric) { return metric.is_more_better ? "more" : "less"; }

}  // namespace

Assessment AssessFrames(std::span<const AttemptFrame> frames, const Scene& scene,
                        const MetricLimits& limits) {
  Assessment assessment;
  assessment.duration = kFrameTime * static_cast<double>(frames.size());
  assessment.frames = frames.size();
  assessment.unknown =
      static_cast<std::size_t>(std::count_if(frames.begin(), frames.end(), [](const auto& frame) {
        return !frame.tool[0].is_valid && !frame.tool[1].is_valid;
      }));
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

std::string AssessmentTable(const Assessment& assessment) {
  std::string text = "metric,part,value,unit,better,why_none\n";
  for (const MetricValue& value : assessment.values)
    text += fmt::format("{},{},{},{},{},{}\n", value.metric->id, CsvField(value.part),
                        value.value ? fmt::format("{}", *value.value) : "", value.metric->unit,
                        Better(*value.metric), CsvField(value.why_none));
  return text;
}

std::string AssessmentReport(const Assessment& assessment, const std::string& scene_title) {
  nlohmann::ordered_json json;
  json["schema"] = "arthroscene.assessment/1";
  json["scene"] = scene_title;
  json["duration"] = assessment.duration;
  json["frames"] = assessment.frames;
  json["unknown_frames"] = assessment.unknown;
  json["metrics_version"] = kMetricsVersion;
  json["metrics"] = nlohmann::ordered_json::array();
  for (const MetricValue& value : assessment.values) {
    nlohmann::ordered_json& entry = json["metrics"].emplace_back();
    entry["metric"] = value.metric->id;
    entry["part"] = value.part;
    entry["value"] = value.value ? nlohmann::ordered_json(*value.value) : nullptr;
    entry["unit"] = value.metric->unit;
    entry["better"] = Better(*value.metric);
    entry["help"] = value.metric->help;
    if (!value.value) entry["why_none"] = value.why_none;
  }
  return json.dump(2) + "\n";
}

}  // namespace arthro::simulation

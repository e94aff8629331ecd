// The metrics of a recorded attempt as a table and as a report [method.md, Metrics].
#pragma once

#include <span>
#include <string>
#include <vector>

#include "simulation/practice/replay.h"
#include "simulation/training/metrics/metrics.h"

namespace arthro::simulation {

struct Assessment {
  double duration = 0;                  // s of the recording
  std::size_t frames = 0, unknown = 0;  // frames; those in which neither hand is known
  std::vector<MetricValue> values;
};

// Replays a recording in the scene and measures them. Forces on deformable tissue are
// those of the replay, which steps the tissue on a fixed clock, not those of the practice itself.
Assessment Assess(const LoadedScene& loaded, const Recording& recording,
                  const SessionOptions& options = {}, const MetricLimits& limits = {},
                  const Progress& progress = {}, const std::vector<TissuePreset>& presets = {},
                  std::vector<std::string>* messages = nullptr);

// Measures frames of an attempt, of which nothing is simulated again.
Assessment AssessFrames(std::span<const AttemptFrame> frames, const Scene& scene,
                        const MetricLimits& limits = {});

// Columns metric, part, value, unit, better (more or less) and why_none.
std::string AssessmentTable(const Assessment& assessment);

// JSON of the schema arthroscene.assessment/1.
std::string AssessmentReport(const Assessment& assessment, const std::string& scene_title);

}  // namespace arthro::simulation

// The metrics of recorded hands, without an exercise [method.md, Metrics]. Reports are written by
// app/report.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "simulation/practice/replay/replay.h"
#include "simulation/training/metrics/metrics.h"

namespace arthro::simulation {

struct Assessment {
  double duration = 0;  // s of the recording
  std::vector<AttemptFrame> frames;
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

}  // namespace arthro::simulation

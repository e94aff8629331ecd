// Made-up frames for tests of metrics, and values of metrics by id and part.
#pragma once

#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "simulation/training/metrics/exercise_metrics.h"
#include "tests/simulation/training/step_frames.h"

namespace arthro::test {

// Frames in which both tools rest in the joint, apart from one: its tip lies at `tip_at(k)` in
// frame k.
template <class TipAt>
std::vector<simulation::AttemptFrame> FramesOfTip(int count, simulation::DeviceRole role,
                                                  const TipAt& tip_at, int targets = 1) {
  std::vector<simulation::AttemptFrame> frames(static_cast<std::size_t>(count),
                                               QuietFrame(targets));
  for (int k = 0; k < count; ++k) {
    simulation::ToolFrame& tool = frames[static_cast<std::size_t>(k)].tool[simulation::Index(role)];
    tool.tip = tool.drawn_tip = glm::vec3(tip_at(k));
  }
  return frames;
}

// Adds `count` frames like `frame`.
inline void Append(std::vector<simulation::AttemptFrame>& frames, int count,
                   const simulation::AttemptFrame& frame) {
  frames.insert(frames.end(), static_cast<std::size_t>(count), frame);
}

// Value of a metric. NaN, which no comparison accepts, stands for a missing value.
inline double ValueIn(const std::vector<simulation::MetricValue>& values, std::string_view id,
                      std::string_view part) {
  for (const simulation::MetricValue& value : values)
    if (value.metric->id == id && value.part == part)
      return value.value.value_or(std::numeric_limits<double>::quiet_NaN());
  ADD_FAILURE() << "no metric " << id << " of " << part;
  return std::numeric_limits<double>::quiet_NaN();
}

// True where the metric has no value and says why.
inline bool IsMissingIn(const std::vector<simulation::MetricValue>& values, std::string_view id,
                        std::string_view part) {
  for (const simulation::MetricValue& value : values)
    if (value.metric->id == id && value.part == part)
      return !value.value.has_value() && !value.why_none.empty();
  return false;
}

// Metrics of an attempt at an exercise; `acts` holds those of each frame, or is empty.
inline std::vector<simulation::MetricValue> MeasuredAttempt(
    const Exercise& exercise, std::span<const simulation::AttemptFrame> frames,
    std::span<const std::vector<simulation::TraineeAct>> acts = {},
    const simulation::GhostPath* ghost = nullptr) {
  simulation::StepEngine engine(exercise);
  simulation::AdvanceAll(engine, frames, acts);
  engine.Finish();
  return simulation::MeasureExercise(frames, engine, {"backdrop"}, {}, ghost);
}

}  // namespace arthro::test

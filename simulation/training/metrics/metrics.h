// Numbers that describe an attempt, each a function of its frames alone [method.md, Metrics]. A
// number that could not be measured says why; it is never 0 or NaN. SI units.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "simulation/tissue/body/tissue_preset.h"
#include "simulation/training/observe/attempt_frame.h"

namespace arthro::simulation {

// Raised when the same frames would give another value.
inline constexpr int kMetricsVersion = 3;

struct Metric {
  std::string_view id, name, unit, help;  // `name`: for a reader
  bool is_more_better = false;
};

struct MetricValue {
  const Metric* metric = nullptr;
  std::string part;  // scope, instrument or both; for contacts the tool and what it touched
  std::optional<double> value;
  std::string why_none;  // empty with a value
  friend bool operator==(const MetricValue&, const MetricValue&) = default;
};

// Every metric, in the order in which values are given.
std::span<const Metric> EveryMetric();

struct MetricLimits {
  double harm = kSafeProbingForce;  // N
};

// `surfaces`: name of the backdrop, then of each tissue, as a tool's contact counts them.
std::vector<MetricValue> MeasureAttempt(std::span<const AttemptFrame> frames,
                                        const std::vector<std::string>& surfaces,
                                        const MetricLimits& limits = {});

}  // namespace arthro::simulation

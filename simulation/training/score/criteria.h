// Criteria of an exercise against the values that were measured, and the outcome of an attempt
// [method.md, Score]. A value that was not measured does not meet its criterion. Nothing sums the
// criteria up.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "simulation/scene/exercise/exercise.h"
#include "simulation/training/attempt_result.h"
#include "simulation/training/steps/step_engine.h"

namespace arthro::simulation {

// Results of a group for one metric and part. `mean` and `sd` are of the values as measured.
struct GroupValues {
  std::string group, metric, part;
  int n = 0;
  double mean = 0, sd = 0;
};

inline constexpr int kSmallestGroup = 5;  // members; a smaller group sets no limit and no z-value

std::vector<CriterionResult> JudgeCriteria(std::span<const Criterion> criteria,
                                           std::span<const MetricValue> values,
                                           std::span<const GroupValues> groups = {});

// "Peak force (instrument): 9.31 N, asked for at most 8.5 N"
std::string CriterionWords(const CriterionResult& criterion);

// The result of an attempt that has ended: passed when it is not void, came to its end with every
// required step that began done, and met every criterion.
AttemptResult ResultOf(const StepEngine& engine, std::vector<MetricValue> values,
                       std::span<const GroupValues> groups = {});

// Distance of a value from the mean of a group in standard deviations; positive is better. Metrics
// of s, m and m² are compared by their logarithms: `values` are those of the group's members.
// Nothing for fewer than five members, for members that do not differ, or for logarithms of values
// that are not positive.
std::optional<double> ZValue(const Metric& metric, double value, std::span<const double> values);

// One sentence per criterion whose metric does not exist or whose part is missing, with the key in
// scene.json; empty: none.
std::vector<std::string> CriterionFaults(const Scene& scene);

}  // namespace arthro::simulation

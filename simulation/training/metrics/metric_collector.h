// Collects metrics of the table by their ids.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "simulation/training/metrics/metrics.h"

namespace arthro::simulation {

class MetricCollector {
 public:
  // `id` is one of EveryMetric.
  void Give(std::string_view id, std::string part, std::optional<double> value,
            std::string_view why_none = {});
  // In the order of the table.
  std::vector<MetricValue> InOrder() &&;

 private:
  std::vector<MetricValue> values_;
};

}  // namespace arthro::simulation

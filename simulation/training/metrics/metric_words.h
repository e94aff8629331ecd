// Metrics and their values in the words and units of a reader: mm, degrees, mm².
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace arthro::simulation {

// Files hold SI units; a person reads these.
struct ShownUnit {
  double factor;  // factor of a value in SI
  std::string words;
};
ShownUnit ShownUnitOf(const std::string& unit);

// A metric's name with the tool it is about: "Peak force (instrument)". A metric of another program
// has its id without underscores.
std::string MetricWords(const std::string& metric, const std::string& part);

// Parts in which a metric is measured, the one that a criterion asks for most first; empty: parts
// that depend on the scene, a tool and what it touches.
std::vector<std::string> PartsOf(std::string_view metric);

// Limits of a value in SI units.
struct ValueLimits {
  std::optional<double> low, high;
};

// A value with its unit, such as "252 mm" for 0.252 m; "not measured" for nothing. Three digits,
// and more where a limit would otherwise seem to be kept that is not.
std::string ValueWords(const std::optional<double>& value, const std::string& unit,
                       const ValueLimits& limits = {});

// "at most 8.5 N", "at least 0.9", "between 0.5 and 3 N"; empty without a limit.
std::string LimitWords(const ValueLimits& limits, const std::string& unit);

}  // namespace arthro::simulation

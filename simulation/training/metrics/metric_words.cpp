#include "simulation/training/metrics/metric_words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "simulation/core/units.h"
#include "simulation/training/metrics/metrics.h"

namespace arthro::simulation {
namespace {

// Rounding of sums leaves values below this, which say nothing about an attempt, in shown units.
constexpr double kLeastShown = 5e-5;
constexpr int kDigits = 3, kMostDigits = 9;

// Metrics that are measured in one part; the others in each tool.
constexpr std::array<std::string_view, 9> kOfBoth = {"task_time",    "idle_share", "bimanual_r",
                                                     "track_error",  "line_error", "marked_area",
                                                     "zone_entries", "look_downs", "lens_near"};
constexpr std::array<std::string_view, 5> kOfScope = {"horizon", "disturbed_share", "seen_share",
                                                      "centring", "distance_error"};
constexpr std::array<std::string_view, 14> kOfInstrument = {
    "tool_loss", "loss_episodes", "triangulation", "taken_share",  "taken_outside",
    "rim_min",   "contour_rms",   "bites",         "empty_bites",  "bites_outside",
    "drops",     "probed_share",  "band_share",    "measure_error"};
constexpr std::array<std::string_view, 4> kOfContact = {"contacts", "contact_time", "contact_path",
                                                        "contact_impulse"};

// Significant digits, and whole numbers as such.
std::string Digits(double value, int digits) {
  if (std::abs(value) < kLeastShown) return "0";
  const double whole = std::pow(10.0, digits);
  return std::abs(value) >= whole - 0.5 ? fmt::format("{:.0f}", value)
                                        : fmt::format("{:.{}g}", value, digits);
}

// Limits are written by a person, as they are.
std::string LimitDigits(double value) { return Digits(value, 6); }

std::string WithUnit(const std::string& digits, const std::string& unit) {
  return unit.empty() ? digits : fmt::format("{} {}", digits, unit);
}

// True where what is written of the value lies on the other side of a limit.
bool Misleads(double value, const std::string& written, const ValueLimits& limits, double factor) {
  const double shown = std::strtod(written.c_str(), nullptr);
  const auto is_over = [&](double each) { return limits.high && each > *limits.high * factor; };
  const auto is_under = [&](double each) { return limits.low && each < *limits.low * factor; };
  return is_over(value) != is_over(shown) || is_under(value) != is_under(shown);
}

}  // namespace

ShownUnit ShownUnitOf(const std::string& unit) {
  if (unit == "m") return {1e3, "mm"};
  if (unit == "m2") return {1e6, "mm²"};
  if (unit == "m3") return {1e9, "mm³"};
  if (unit == "1/min") return {1, "per min"};
  if (unit == "rad") return {1 / kRadianPerDegree, "°"};
  return {1, unit};
}

std::string MetricWords(const std::string& metric, const std::string& part) {
  std::string words = metric;
  std::ranges::replace(words, '_', ' ');
  for (const Metric& known : EveryMetric())
    if (known.id == metric) words = known.name;
  return part.empty() || part == "both" ? words : fmt::format("{} ({})", words, part);
}

std::vector<std::string> PartsOf(std::string_view metric) {
  const auto is_in = [&](const auto& metrics) { return std::ranges::count(metrics, metric) > 0; };
  if (is_in(kOfBoth)) return {"both"};
  if (is_in(kOfScope)) return {"scope"};
  if (is_in(kOfInstrument)) return {"instrument"};
  if (is_in(kOfContact)) return {};
  return {"instrument", "scope"};
}

std::string ValueWords(const std::optional<double>& value, const std::string& unit,
                       const ValueLimits& limits) {
  if (!value) return "not measured";
  const ShownUnit shown = ShownUnitOf(unit);
  const double number = *value * shown.factor;
  int digits = kDigits;
  std::string written = Digits(number, digits);
  while (digits < kMostDigits && Misleads(number, written, limits, shown.factor))
    written = Digits(number, ++digits);
  return WithUnit(written, shown.words);
}

std::string LimitWords(const ValueLimits& limits, const std::string& unit) {
  const ShownUnit shown = ShownUnitOf(unit);
  const auto number = [&](double value) { return LimitDigits(value * shown.factor); };
  if (limits.low && limits.high)
    return WithUnit(fmt::format("between {} and {}", number(*limits.low), number(*limits.high)),
                    shown.words);
  if (limits.high) return WithUnit("at most " + number(*limits.high), shown.words);
  if (limits.low) return WithUnit("at least " + number(*limits.low), shown.words);
  return "";
}

}  // namespace arthro::simulation

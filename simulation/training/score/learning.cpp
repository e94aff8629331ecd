#include "simulation/training/score/learning.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace arthro::simulation {
namespace {

// ln(p1/p0) and ln((1 − p0)/(1 − p1)); their sum scales the steps.
double LogOfFail(const CusumRule& rule) { return std::log(rule.unacceptable / rule.acceptable); }
double LogOfPass(const CusumRule& rule) {
  return std::log((1 - rule.acceptable) / (1 - rule.unacceptable));
}
double Scale(const CusumRule& rule) { return LogOfFail(rule) + LogOfPass(rule); }

}  // namespace

std::vector<std::optional<double>> RunningMedian(std::span<const std::optional<double>> values) {
  std::vector<std::optional<double>> medians;
  std::vector<double> known;
  for (const std::optional<double>& value : values) {
    if (value) known.push_back(*value);
    std::vector<double> last(
        known.end() - std::min<std::ptrdiff_t>(3, static_cast<std::ptrdiff_t>(known.size())),
        known.end());
    std::sort(last.begin(), last.end());
    const std::size_t n = last.size();
    medians.push_back(n == 0 ? std::nullopt
                             : std::optional(0.5 * (last[(n - 1) / 2] + last[n / 2])));
  }
  return medians;
}

double CusumOfPass(const CusumRule& rule) { return -LogOfPass(rule) / Scale(rule); }
double CusumOfFail(const CusumRule& rule) { return LogOfFail(rule) / Scale(rule); }
double CusumUpperLine(const CusumRule& rule) {
  return std::log((1 - rule.beta) / rule.alpha) / Scale(rule);
}
double CusumLowerLine(const CusumRule& rule) {
  return -std::log((1 - rule.alpha) / rule.beta) / Scale(rule);
}

std::vector<double> Cusum(std::span<const bool> passed, const CusumRule& rule) {
  std::vector<double> sums;
  double sum = 0;
  for (const bool is_pass : passed)
    sums.push_back(sum += is_pass ? CusumOfPass(rule) : CusumOfFail(rule));
  return sums;
}

GateState GateOf(const ExerciseGate& gate, const std::string& exercise_hash,
                 std::span<const GateAttempt> attempts) {
  GateState state;
  int older = 0;
  for (const GateAttempt& attempt : attempts) {
    if (!attempt.is_test) continue;
    if (attempt.exercise_hash != exercise_hash) {
      older += attempt.is_passed ? 1 : 0;
      continue;
    }
    if (state.consecutive < gate.consecutive)
      state.consecutive = attempt.is_passed ? state.consecutive + 1 : 0;
    else if (attempt.is_passed)
      ++state.in_total;
  }
  state.in_total = std::min(state.in_total, gate.in_total);
  state.is_open = state.consecutive >= gate.consecutive && state.in_total >= gate.in_total;
  if (state.is_open) return state;
  state.reason = state.consecutive < gate.consecutive
                     ? fmt::format("Pass the test {} more time{} in a row.",
                                   gate.consecutive - state.consecutive,
                                   gate.consecutive - state.consecutive == 1 ? "" : "s")
                     : fmt::format("Pass the test {} more time{}.", gate.in_total - state.in_total,
                                   gate.in_total - state.in_total == 1 ? "" : "s");
  if (older > 0)
    state.reason += fmt::format(" {} pass{} at an earlier version of the exercise {} not count.",
                                older, older == 1 ? "" : "es", older == 1 ? "does" : "do");
  return state;
}

}  // namespace arthro::simulation

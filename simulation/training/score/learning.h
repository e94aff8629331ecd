// A trainee's attempts at one exercise over time: learning curve, CUSUM and gate [method.md,
// Score]. Attempts are given in the order in which they were made.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "simulation/scene/exercise/exercise.h"

namespace arthro::simulation {

// Middle of the last three values, or of fewer at the beginning; values that are missing are left
// out. One per attempt; nothing while there is no value.
std::vector<std::optional<double>> RunningMedian(std::span<const std::optional<double>> values);

// Sequential test of a failure rate of 10 % against one of 30 %, with errors of 10 % each [Bolsin &
// Colson 2000]. It advises; it decides nothing.
struct CusumRule {
  double acceptable = 0.10, unacceptable = 0.30;  // failure rates p0, p1
  double alpha = 0.10, beta = 0.10;               // errors
};
double CusumOfPass(const CusumRule& rule = {});  // step of the sum; negative
double CusumOfFail(const CusumRule& rule = {});
double CusumUpperLine(const CusumRule& rule = {});  // crossed upwards: too many failures
double CusumLowerLine(const CusumRule& rule = {});  // crossed downwards: few enough
// The sum after each attempt.
std::vector<double> Cusum(std::span<const bool> passed, const CusumRule& rule = {});

struct GateAttempt {
  std::string exercise_hash;
  bool is_test = false;  // mode test; practice does not count
  bool is_passed = false;
};

struct GateState {
  bool is_open = false;
  int consecutive = 0;  // passes in a row, as far as the gate asks for them
  int in_total = 0;     // passes after those
  std::string reason;   // why it is shut, one sentence; empty: it is open
};

// `consecutive` passes in a row open the second part, which asks for `in_total` more passes, in a
// row or not [FLS: 2 and 10]. Attempts at another version of the exercise do not count.
GateState GateOf(const ExerciseGate& gate, const std::string& exercise_hash,
                 std::span<const GateAttempt> attempts);

// An exercise is open when the gates of all exercises that it needs are; else the id of the first
// that is not. `is_open(id)` says it of one.
template <class IsOpen>
std::string FirstShut(const Exercise& exercise, const IsOpen& is_open) {
  for (const std::string& id : exercise.needs)
    if (!is_open(id)) return id;
  return "";
}

}  // namespace arthro::simulation

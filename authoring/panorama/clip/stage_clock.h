// Clock of the stages of a long job: cost of each, progress of the whole, remaining time.
#pragma once

#include <chrono>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "simulation/core/progress.h"

namespace arthro::authoring {

struct StageCost {
  std::string name;
  double cpu_ms = 0;
};

class StageClock {
 public:
  // `shares`: the stages in order, each with its expected part of the work, in any unit.
  StageClock(const Progress& whole, std::vector<std::pair<std::string, double>> shares);

  // Ends the stage before and starts this one. The returned Progress reports the stage's progress
  // as that of the whole job, with its words and the time left; it must not outlive the clock.
  Progress Begin(const std::string& name);
  void End();

  const std::vector<StageCost>& costs() const { return costs_; }

 private:
  void Report(std::string_view words, double done);

  Progress whole_;
  std::vector<std::pair<std::string, double>> shares_;
  double total_ = 0, before_ = 0, share_ = 0;  // before_: completed stages
  double done_ = 0;                            // share of the whole, 0 to 1; never decreases
  double cpu_at_begin_ = 0;
  bool is_running_ = false;
  std::chrono::steady_clock::time_point started_;
  std::vector<StageCost> costs_;
};

// Text such as "about 40 s left"; "" while it is too early for an estimate.
std::string TimeLeft(double seconds_so_far, double done);

}  // namespace arthro::authoring

// The stages of one long job: what each costs, how far the whole is, how long it will take.
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
  // `shares`: the stages in order with what part of the work each is expected to be, any unit.
  StageClock(const Progress& whole, std::vector<std::pair<std::string, double>> shares);

  // Ends the stage before and starts this one. What is returned reports the stage's progress as
  // progress of the whole job, with its words and the time left, and must not outlive the clock.
  Progress Begin(const std::string& name);
  void End();

  const std::vector<StageCost>& costs() const { return costs_; }

 private:
  void Report(std::string_view words, double done);

  Progress whole_;
  std::vector<std::pair<std::string, double>> shares_;
  double total_ = 0, before_ = 0, share_ = 0;  // before_: of the stages that are over
  double done_ = 0;                            // of the whole, 0 to 1; never goes back
  double cpu_at_begin_ = 0;
  bool is_running_ = false;
  std::chrono::steady_clock::time_point started_;
  std::vector<StageCost> costs_;
};

// "about 40 s left"; "" while it is too early to say.
std::string TimeLeft(double seconds_so_far, double done);

}  // namespace arthro::authoring

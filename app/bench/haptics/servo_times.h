// Time of a servo tick, by stage and as a whole. Two simulated hands stroke over a backdrop of
// waves and over triangles in front of half of it, in the servo's own loop. The simulation of the
// hands is timed separately and subtracted. Times in s, by the steady clock.
#pragma once

#include <string>
#include <vector>

#include "simulation/core/progress.h"

namespace arthro::app {

struct ServoTimesOptions {
  int ticks = 20000;  // 1 ms each, one minute at most
  int rounds = 5;
  long (*heap_calls)() noexcept = nullptr;  // heap calls of this thread so far; null: not counted
};

struct ServoTime {
  std::string what, about;
  double p50 = 0, p99 = 0, p999 = 0;  // over all calls of all rounds
  // Quantiles of the least time of each tick over all rounds, which leaves out the time that other
  // programs took. Every round has the same ticks.
  double calm_p50 = 0, calm_p99 = 0, calm_p999 = 0;
};

struct ServoTimes {
  std::vector<ServoTime> rows;
  long ticks = 0, heap_calls = 0;  // sums over all rounds of the whole tick
};

ServoTimes MeasureServo(const ServoTimesOptions& options, const Progress& progress);

}  // namespace arthro::app

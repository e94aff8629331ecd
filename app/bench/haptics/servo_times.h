// What a tick of the servo costs, stage by stage and as a whole: two simulated hands stroke over a
// backdrop of waves, and over triangles that stand half before it, by the servo's own loop. The
// simulation of the hands is timed on its own and taken off. s, of the steady clock.
#pragma once

#include <string>
#include <vector>

#include "simulation/core/progress.h"

namespace arthro::app {

struct ServoTimesOptions {
  int ticks = 20000;  // of 1 ms, at most a minute's
  int rounds = 5;
  long (*heap_calls)() noexcept = nullptr;  // of this thread so far; null: they are not counted
};

struct ServoTime {
  std::string what, about;
  double p50 = 0, p99 = 0, p999 = 0;  // of all calls of all rounds
  // Every round has the same ticks; of each the least of all rounds. What other programs took of
  // the machine is not in it.
  double calm_p50 = 0, calm_p99 = 0, calm_p999 = 0;
};

struct ServoTimes {
  std::vector<ServoTime> rows;
  long ticks = 0, heap_calls = 0;  // of the whole tick, all rounds
};

ServoTimes MeasureServo(const ServoTimesOptions& options, const Progress& progress);

}  // namespace arthro::app

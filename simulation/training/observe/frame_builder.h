// Frames of an attempt from the ticks of a session, all of them in memory.
#pragma once

#include <vector>

#include "simulation/training/observe/tick_average.h"

namespace arthro::simulation {

class FrameBuilder {
 public:
  // `start`: time of the attempt's begin, s.
  explicit FrameBuilder(double start) : ticks_(start) {}

  // See TickAverage::Add and Finish.
  void Add(double t, const Snapshot& snapshot, bool is_paused = false) {
    ticks_.Add(t, snapshot, is_paused);
    TakeAll();
  }
  void Finish() {
    ticks_.Finish();
    TakeAll();
  }

  const std::vector<AttemptFrame>& frames() const { return frames_; }

 private:
  void TakeAll() {
    for (AttemptFrame frame; ticks_.Take(frame);) frames_.push_back(frame);
  }

  TickAverage ticks_;
  std::vector<AttemptFrame> frames_;
};

}  // namespace arthro::simulation

// Frames of an attempt from the ticks of a session. Frame k holds the ticks in (10 k, 10 k + 10] ms
// after the start.
#pragma once

#include <vector>

#include "simulation/practice/snapshot.h"
#include "simulation/training/observe/attempt_frame.h"

namespace arthro::simulation {

class FrameBuilder {
 public:
  // `start`: time of the attempt's begin, s.
  explicit FrameBuilder(double start) : start_(start), last_(start) {}

  // Takes the state after the tick at `t`; ticks come in the order of their times, and one that
  // does not lie after the last is left out. A frame without a tick is not valid.
  void Add(double t, const Snapshot& snapshot, bool is_paused = false);

  // Ends the frame that is under way, unless no tick lies in it.
  void Finish();

  const std::vector<AttemptFrame>& frames() const { return frames_; }

 private:
  struct ToolSum {
    glm::dvec3 tip{0.0}, drawn_tip{0.0}, axis{0.0};
    double force = 0, peak_force = 0, roll = 0, depth = 0;
    std::vector<double> contact;  // s, indexed by surface
    bool is_valid = true;
  };
  void Close();

  double start_, last_, time_ = 0;  // time_: s of the ticks in the frame under way
  bool is_paused_ = false;
  std::array<ToolSum, 2> sum_;
  std::vector<AttemptFrame> frames_;
};

}  // namespace arthro::simulation

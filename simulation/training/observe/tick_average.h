// Frames of an attempt as means of the ticks of a session, on the servo's thread: noexcept,
// allocates nothing. Frame k holds the ticks in (10 k, 10 k + 10] ms after the start. Portal frame,
// m, N, s.
#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include "simulation/practice/snapshot.h"
#include "simulation/training/observe/attempt_frame.h"

namespace arthro::simulation {

class TickAverage {
 public:
  // `start`: time of the attempt's begin, s.
  explicit TickAverage(double start) : start_(start), last_(start) {}

  // Takes the state after the tick at `t`; ticks come in the order of their times, and one that
  // does not lie after the last is left out. Take the ended frames after each call.
  void Add(double t, const Snapshot& snapshot, bool is_paused = false) noexcept;
  // Ends the frame that is under way, unless no tick lies in it.
  void Finish() noexcept;

  // Takes the oldest ended frame; a frame without a tick is not valid. Returns false where there is
  // none.
  bool Take(AttemptFrame& frame) noexcept;

 private:
  static constexpr std::size_t kMostContacts = 16;  // surfaces in one frame
  struct ToolSum {
    glm::dvec3 tip{0.0}, drawn_tip{0.0}, axis{0.0};
    double force = 0, peak_force = 0, roll = 0, depth = 0;
    std::array<std::pair<int, double>, kMostContacts> contact;  // surface, s
    std::size_t contacts = 0;
    bool is_valid = true;
  };
  void Close() noexcept;

  double start_, last_, time_ = 0;  // time_: s of the ticks in the frame under way
  long long index_ = 0;             // number of the frame under way
  bool is_paused_ = false;
  std::array<ToolSum, 2> sum_;
  AttemptFrame now_;  // values of the last tick
  // Ended frames that were not taken: one with ticks, then a number of empty ones.
  AttemptFrame closed_;
  bool has_closed_ = false;
  long long empty_ = 0;
};

}  // namespace arthro::simulation

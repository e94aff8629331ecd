// State of a step while it is under way. Vectors get their sizes when the step starts; no frame
// allocates.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "simulation/training/observe/attempt_frame.h"

namespace arthro::simulation {

inline constexpr int kForgivenGap = 10;  // frames, 0.1 s, by which a condition may be missed

// Frames of `seconds`; at least one.
inline int FramesOf(double seconds) {
  const int frames = static_cast<int>(seconds / kFrameTime + 0.5);
  return frames > 1 ? frames : 1;
}

// Time for which a condition holds without a gap longer than the forgiven one.
struct Dwell {
  int frames = 0;  // gaps that were forgiven count
  int gap = 0;
  bool is_done = false;

  // Returns true when a longer gap ends what had lasted longer than a gap may.
  bool Add(bool holds, int forgiven = kForgivenGap) {
    if (holds) {
      frames += 1 + gap;
      gap = 0;
      return false;
    }
    if (frames == 0) return false;
    if (++gap <= forgiven) return false;
    const bool is_loss = frames > forgiven;
    frames = gap = 0;
    return is_loss;
  }
};

struct StepState {
  int frames = 0;            // since its start, without pauses
  bool is_cue_due = false;   // the cue is shown
  std::vector<int> targets;  // numbers in the exercise
  std::vector<Dwell> dwell;  // per target
  std::size_t at = 0;        // target, piece of the path or end of the way that comes next
  int cycles = 0;            // cycles of a telescope
  double way = 0;            // m, way of a moving goal from the start of its path
  bool has_departed = false;
  glm::dvec3 anchor{0.0};            // place of a periscope's tip
  std::vector<std::uint8_t> pieces;  // pieces of a path; 1: followed
  std::vector<glm::dvec3> marks;     // per target of a measurement
  std::vector<glm::dvec3> places;    // per target, in the frame before
  int held = -1;                     // body in the grasper
  glm::dvec3 bite{0.0};              // place at which tissue was taken last
  bool has_bitten = false;
  double progress = 0;  // 0 to 1
};

}  // namespace arthro::simulation

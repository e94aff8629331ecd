// Sums that the steps of an attempt collect for its metrics: only the steps know where a moving
// goal was and which part of a path came next. m, frames.
#pragma once

#include <cmath>
#include <optional>

namespace arthro::simulation {

// Mean and root mean square of values.
struct ValueSum {
  double sum = 0, squares = 0;
  int count = 0;
  void Add(double value) {
    sum += value;
    squares += value * value;
    ++count;
  }
  std::optional<double> mean() const {
    return count > 0 ? std::optional(sum / count) : std::nullopt;
  }
  std::optional<double> rms() const {
    return count > 0 ? std::optional(std::sqrt(squares / count)) : std::nullopt;
  }
};

struct AttemptMeasures {
  ValueSum centring;        // distance of the target from the picture's centre; 1 is the rim
  ValueSum distance_error;  // m, distance of the lens from the range that is asked for
  ValueSum track_error;     // m, from the moving goal
  ValueSum line_error;      // m, from the path
  ValueSum measure_error;   // m, of a measured distance
  int to_see = 0, seen = 0;
  int to_probe = 0, probed = 0;
  int pressed = 0, in_band = 0;  // frames on a target to press; those with a force that it asks for
  double marked_area = 0;        // m², touched with more than the safe probing force
};

}  // namespace arthro::simulation

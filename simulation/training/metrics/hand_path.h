// Ways of a tool's tip in an attempt, without the tremor of device and clock: a Butterworth filter
// of second order runs forwards and backwards, −3 dB at 10 Hz together, and shifts nothing in time.
// Portal frame, m, s.
#pragma once

#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "simulation/training/observe/attempt_frame.h"

namespace arthro::simulation {

// Frames without a pause or a fault in which the tip lies in the joint.
struct HandPath {
  std::size_t first = 0;        // frame
  std::vector<glm::dvec3> tip;  // filtered, one per frame
  std::vector<double> speed;    // m/s, central differences of `tip`
  double duration() const { return kFrameTime * static_cast<double>(tip.size()); }
};

// One path for each unbroken stretch of at least three frames.
std::vector<HandPath> HandPathsOf(std::span<const AttemptFrame> frames, DeviceRole role);

// The filter. The signal is continued at both ends by 30 frames, turned about its end point.
std::vector<double> WithoutTremor(std::span<const double> signal);

}  // namespace arthro::simulation

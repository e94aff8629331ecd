// Frames of made-up hands, through the builder that a practice uses: ticks at the rate of a device.
#pragma once

#include <functional>
#include <vector>

#include <glm/geometric.hpp>

#include "simulation/training/observe/frame_builder.h"

namespace arthro::test {

// State of both tools at `t`, s.
using Hands = std::function<simulation::Snapshot(double t)>;

inline std::vector<simulation::AttemptFrame> FramesOf(double duration, double rate,
                                                      const Hands& hands) {
  simulation::FrameBuilder builder(0.0);
  const auto ticks = static_cast<long>(duration * rate + 0.5);
  for (long i = 1; i <= ticks; ++i) {
    const double t = static_cast<double>(i) / rate;
    builder.Add(t, hands(t));
  }
  builder.Finish();
  return builder.frames();
}

// A tool in the joint whose tip is at `tip`; its rod points to it from the origin.
inline simulation::ToolState ToolAt(const glm::dvec3& tip) {
  simulation::ToolState state;
  state.tip_in_portal = state.proxy_in_portal = tip;
  const double depth = glm::length(tip);
  state.pose.depth = depth;
  state.pose.latitude = std::asin(-tip.y / depth);
  state.pose.longitude = std::atan2(tip.x, tip.z);
  state.fault = simulation::Fault::kNone;
  return state;
}

}  // namespace arthro::test

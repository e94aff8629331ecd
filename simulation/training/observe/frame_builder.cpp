#include "simulation/training/observe/frame_builder.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace arthro::simulation {
namespace {

// Share of a frame by which a tick may lie late, so that a tick at 10 ms falls into the first frame
// although its time is rounded.
constexpr double kRounding = 1e-6;

// Whether the hand is where the state says.
bool IsKnown(Fault fault) {
  return fault == Fault::kNone || fault == Fault::kNotArmed || fault == Fault::kTissue;
}

}  // namespace

void FrameBuilder::Add(double t, const Snapshot& snapshot, bool is_paused) {
  const double dt = t - last_;
  if (!(dt > 0)) return;
  const auto index =
      static_cast<std::size_t>(std::max(0.0, std::ceil((t - start_) / kFrameTime - kRounding) - 1));
  if (frames_.size() < index) Finish();
  frames_.resize(std::max(frames_.size(), index));  // frames without a tick are not valid
  last_ = t;
  time_ += dt;
  is_paused_ = is_paused_ || is_paused;
  for (const DeviceRole role : kDeviceRoles) {
    const ToolState& state = ToolOf(snapshot, role);
    ToolSum& sum = sum_[Index(role)];
    const double force = glm::length(state.tip_force);
    sum.tip += dt * state.tip_in_portal;
    sum.drawn_tip += dt * state.proxy_in_portal;
    sum.axis += dt * BasisOf(state.pose).axis;
    sum.force += dt * force;
    sum.peak_force = std::max(sum.peak_force, force);
    sum.roll = state.pose.roll;
    sum.depth = state.pose.depth;
    sum.is_valid = sum.is_valid && IsKnown(state.fault);
    if (state.contact < 0) continue;
    const auto surface = static_cast<std::size_t>(state.contact);
    if (sum.contact.size() <= surface) sum.contact.resize(surface + 1, 0.0);
    sum.contact[surface] += dt;
  }
}

void FrameBuilder::Finish() {
  if (time_ > 0) Close();
}

void FrameBuilder::Close() {
  AttemptFrame& frame = frames_.emplace_back();
  frame.is_paused = is_paused_;
  for (const DeviceRole role : kDeviceRoles) {
    ToolSum& sum = sum_[Index(role)];
    ToolFrame& tool = frame.tool[Index(role)];
    tool.tip = glm::vec3(sum.tip / time_);
    tool.drawn_tip = glm::vec3(sum.drawn_tip / time_);
    if (glm::length(sum.axis) > 0) tool.axis = glm::vec3(glm::normalize(sum.axis));
    tool.mean_force = static_cast<float>(sum.force / time_);
    tool.peak_force = static_cast<float>(sum.peak_force);
    tool.roll = static_cast<float>(sum.roll);
    tool.depth = static_cast<float>(sum.depth);
    tool.is_valid = sum.is_valid;
    const auto longest = std::max_element(sum.contact.begin(), sum.contact.end());
    if (longest != sum.contact.end() && *longest > 0) {
      tool.contact = static_cast<int>(longest - sum.contact.begin());
      tool.contact_share = static_cast<float>(*longest / time_);
    }
    sum = {};
  }
  time_ = 0;
  is_paused_ = false;
}

}  // namespace arthro::simulation

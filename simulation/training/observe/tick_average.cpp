#include "simulation/training/observe/tick_average.h"

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

void TickAverage::Add(double t, const Snapshot& snapshot, bool is_paused) noexcept {
  const double dt = t - last_;
  if (!(dt > 0)) return;
  const auto index =
      static_cast<long long>(std::max(0.0, std::ceil((t - start_) / kFrameTime - kRounding) - 1));
  if (index_ < index) {
    if (time_ > 0) Close();
    empty_ += index - index_ - (has_closed_ ? 1 : 0);
    index_ = index;
  }
  last_ = t;
  time_ += dt;
  is_paused_ = is_paused_ || is_paused;
  now_.instrument = snapshot.kind;
  now_.opening = static_cast<float>(snapshot.instrument.opening);
  now_.view_angle = static_cast<float>(snapshot.view_angle);
  now_.head_roll = static_cast<float>(HeadRoll(snapshot.head, snapshot.scope.pose.roll));
  now_.incision_spacing = static_cast<float>(snapshot.incision_spacing);
  now_.haze = static_cast<float>(snapshot.disturbances.haze);
  now_.fog = static_cast<float>(snapshot.disturbances.fog);
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
    const auto end = sum.contact.begin() + static_cast<std::ptrdiff_t>(sum.contacts);
    const auto known = std::find_if(sum.contact.begin(), end, [&](const auto& contact) {
      return contact.first == state.contact;
    });
    if (known != end)
      known->second += dt;
    else if (sum.contacts < kMostContacts)
      sum.contact[sum.contacts++] = {state.contact, dt};
  }
}

void TickAverage::Finish() noexcept {
  if (!(time_ > 0)) return;
  Close();
  ++index_;
}

bool TickAverage::Take(AttemptFrame& frame) noexcept {
  if (has_closed_) {
    frame = closed_;
    has_closed_ = false;
    return true;
  }
  if (empty_ <= 0) return false;
  frame = AttemptFrame();
  --empty_;
  return true;
}

void TickAverage::Close() noexcept {
  closed_ = now_;
  closed_.is_paused = is_paused_;
  for (const DeviceRole role : kDeviceRoles) {
    ToolSum& sum = sum_[Index(role)];
    ToolFrame& tool = closed_.tool[Index(role)];
    tool.tip = glm::vec3(sum.tip / time_);
    tool.drawn_tip = glm::vec3(sum.drawn_tip / time_);
    if (glm::length(sum.axis) > 0) tool.axis = glm::vec3(glm::normalize(sum.axis));
    tool.mean_force = static_cast<float>(sum.force / time_);
    tool.peak_force = static_cast<float>(sum.peak_force);
    tool.roll = static_cast<float>(sum.roll);
    tool.depth = static_cast<float>(sum.depth);
    tool.is_valid = sum.is_valid;
    // The surface with the lowest index wins among equals.
    double longest = 0;
    for (std::size_t i = 0; i < sum.contacts; ++i) {
      const auto [surface, time] = sum.contact[i];
      if (!(time > longest) && !(time == longest && surface < tool.contact)) continue;
      longest = time;
      tool.contact = surface;
    }
    if (longest > 0) tool.contact_share = static_cast<float>(longest / time_);
    sum = {};
  }
  has_closed_ = true;
  time_ = 0;
  is_paused_ = false;
}

}  // namespace arthro::simulation

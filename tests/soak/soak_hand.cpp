#include "tests/soak/soak_hand.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <glm/geometric.hpp>

#include "simulation/core/finite.h"
#include "tests/support/ticks.h"

namespace arthro::test {
namespace {

using namespace simulation;

constexpr double kOut = 0.03, kOutSpeed = 0.06;  // m towards the hand, m/s
// The hand wanders as noise of first order, some 2 mm wide.
constexpr double kPull = 0.8, kNoise = 0.0025;  // 1/s, m/√s

double OwnClock() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

SoakHand::SoakHand(std::vector<TraceRow> rows, std::uint64_t seed, const char* serial)
    : rows_(std::move(rows)),
      random_(seed),
      plant_({}, kHand, rows_.at(0).sample.hip_in_device, serial) {}

// The recording is played to and fro, so that it has no jump.
glm::dvec3 SoakHand::Intent(double t) noexcept {
  const double length = rows_.back().sample.t - rows_.front().sample.t;
  const double place = std::fmod(t, 2 * length);
  const double at = rows_.front().sample.t + (place < length ? place : 2 * length - place);
  const auto next = std::min(
      std::ranges::upper_bound(rows_, at, {}, [](const TraceRow& row) { return row.sample.t; }),
      rows_.end() - 1);
  const auto before = next == rows_.begin() ? next : next - 1;
  const double span = next->sample.t - before->sample.t;
  const double share = span > 0 ? std::clamp((at - before->sample.t) / span, 0.0, 1.0) : 0.0;
  // Uniform numbers with the deviation of one.
  const double width = kNoise * std::sqrt(12 * kTick);
  for (int i = 0; i < 3; ++i) drift_[i] = width * random_.Uniform(-0.5, 0.5);
  wander_ += drift_ - kPull * kTick * wander_;
  out_ = std::clamp(out_ + (is_out_ ? kTick : -kTick) * kOutSpeed / kOut, 0.0, 1.0);
  const glm::dvec3 hip =
      glm::mix(before->sample.hip_in_device, next->sample.hip_in_device, share) + wander_;
  // The device's hip lies beyond the incision: further away is further out.
  return hip + out_ * kOut * glm::normalize(hip);
}

DeviceSample SoakHand::Read(double now) noexcept {
  const double own = OwnClock();
  if (ticks_ == 0)
    first_ = own;
  else
    kept_.between.Add(own - last_);
  last_ = own;
  ++ticks_;
  if (begin_ < 0) begin_ = now;
  plant_.plant().SetIntent(Intent(now - begin_));
  plant_.SetButtons(is_pressed_ ? 1u : 0u);
  return plant_.Read(now);
}

// Ticks that fit into the time, without those that came.
void SoakHand::EndStretch() noexcept {
  if (ticks_ == 0) return;
  kept_.ticks += ticks_;
  kept_.left_out += std::lround((last_ - first_) / kTick) + 1 - ticks_;
  ++kept_.stretches;
  ticks_ = 0;
}

void SoakHand::Command(const glm::dvec3& force) noexcept {
  const double length = glm::length(force);
  kept_.not_finite += !IsFinite(force);
  kept_.above_peak += length > caps().peak_force * (1 + 1e-9);
  kept_.pushed += length > 0;
  kept_.largest = std::max(kept_.largest, length);
  plant_.Command(force);
}

}  // namespace arthro::test

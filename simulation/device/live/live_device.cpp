#include "simulation/device/live/live_device.h"

#include <cmath>
#include <utility>

#include "simulation/core/finite.h"

namespace arthro::simulation {
namespace {

// A held knob repeats its report every 8 to 16 ms; a silent one is released.
constexpr double kPushLasts = 0.25;  // s

}  // namespace

LiveDevice::LiveDevice(std::shared_ptr<LiveLink> link, int hand, const RateHand& rest,
                       const RateOptions& rate)
    : link_(std::move(link)),
      hand_(hand),
      name_(Name(link_->request().family)),
      rate_hand_(rest),
      rate_(rate) {
  if (link_->hands() > 1) name_ += hand == 0 ? ", first hand" : ", second hand";
}

DeviceSample LiveDevice::Read(double now) noexcept {
  const HandNews& news = link_->Newest(hand_);
  const DeviceCaps& caps = link_->caps();
  const int opening = link_->opening();
  const bool is_current = opening != 0 && news.opening == opening;
  const double age = now - news.reading.sample.t;
  events_.is_present = link_->is_present();
  events_.is_open = opening != 0;
  if (IsSteady(caps)) {
    events_.has_sample = is_current;
    // A report that arrived after `now` was measured counts as of `now`.
    events_.sample_age = age < 0 ? 0 : age;
  } else {
    events_.has_sample = events_.is_open;
    events_.sample_age = 0;
  }
  // Only an arm needs homing.
  events_.is_homed = is_current ? news.reading.is_homed : !IsSteady(caps);
  events_.trouble = link_->trouble();
  const double began = link_->write_began();
  if (events_.trouble == DeviceTrouble::kNone && began > 0 && now - began > kSlowWrite)
    events_.trouble = DeviceTrouble::kSlowWrite;
  if (events_.trouble == DeviceTrouble::kNone && is_not_finite_)
    events_.trouble = DeviceTrouble::kNotFinite;
  is_not_finite_ = false;
  status_ = Next(status_, events_);
  joints_ = news.reading.joints;

  const bool is_ready =
      status_.state == DeviceState::kReady || status_.state == DeviceState::kArmed;
  DeviceSample sample = is_current ? news.reading.sample : DeviceSample{};
  if (caps.input == HandInput::kRate) {
    if (is_ready && is_current && has_time_ && age < kPushLasts)
      Advance(rate_hand_, news.reading.push, news.reading.turn, now - now_, caps.min_hip,
              caps.max_hip, rate_);
    sample.t = now;
    sample.hip_in_device = rate_hand_.position;
    sample.handle_in_device = rate_hand_.orientation;
    sample.valid = true;
  }
  sample.valid = sample.valid && is_ready && HasHand(caps);
  now_ = now;
  has_time_ = true;
  return sample;
}

void LiveDevice::Command(const glm::dvec3& force_in_device) noexcept {
  const glm::dvec3& f = force_in_device;
  const bool is_finite = IsFinite(f);
  is_not_finite_ = !is_finite;
  force_ = is_finite && MayPush(status_, events_) ? f : glm::dvec3(0.0);
  if (caps().feedback != Feedback::kNone) link_->Send(force_, joints_);
}

}  // namespace arthro::simulation

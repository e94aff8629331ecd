#include "simulation/device/plant_device.h"

#include <cmath>
#include <utility>

#include "simulation/core/finite.h"

namespace arthro::simulation {

PlantDevice::PlantDevice(const PlantOptions& options, const HandModel& hand, const glm::dvec3& at,
                         std::string serial)
    : serial_(std::move(serial)), plant_(options, hand, at) {
  caps_.input = HandInput::kAbsolute;
  caps_.feedback = Feedback::kForce;
  caps_.sensed_dof = caps_.actuated_dof = 3;
  caps_.position_quantum = options.quantum;
  caps_.peak_force = options.peak_force;
  caps_.continuous_force = 0.88 / 3.3 * options.peak_force;  // ratio of a Touch-class device
  caps_.max_stiffness = 500;
  caps_.damping = options.damping;
  caps_.rate = 1000;
  caps_.delay_ticks = options.delay;
  caps_.min_hip = at - glm::dvec3(0.080, 0.060, 0.035);
  caps_.max_hip = at + glm::dvec3(0.080, 0.060, 0.035);
  caps_.buttons = 2;
  caps_.watchdog = 0.1;
  events_.is_homed = true;
  SetPlugged(true);
}

void PlantDevice::SetPlugged(bool is_plugged) noexcept {
  events_.is_present = events_.is_open = is_plugged;
  events_.has_sample = false;
}

DeviceSample PlantDevice::Read(double now) noexcept {
  if (has_time_ && now > now_) plant_.Tick(force_, now - now_);
  now_ = now;
  has_time_ = true;
  if (!is_silent_ && events_.is_open) {
    newest_ = plant_.Sample();
    newest_.t = now;
    newest_.buttons = buttons_;
    events_.has_sample = true;
  }
  events_.sample_age = now - newest_.t;
  status_ = Next(status_, events_);
  events_.trouble = DeviceTrouble::kNone;  // reported once
  DeviceSample sample = newest_;
  sample.valid = status_.state == DeviceState::kReady || status_.state == DeviceState::kArmed;
  return sample;
}

void PlantDevice::Command(const glm::dvec3& force_in_device) noexcept {
  const glm::dvec3& f = force_in_device;
  const bool is_finite = IsFinite(f);
  if (!is_finite) events_.trouble = DeviceTrouble::kNotFinite;
  force_ = MayPush(status_, events_) ? f : glm::dvec3(0.0);
}

}  // namespace arthro::simulation

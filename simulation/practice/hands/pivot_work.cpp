#include "simulation/practice/hands/pivot_work.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace arthro::simulation {

PivotOptions PivotOptionsOf(const DeviceCaps& caps) {
  PivotOptions options;
  // Rounding to a quantum is uniform noise.
  if (caps.position_quantum > 0) options.position_noise = caps.position_quantum / std::sqrt(12.0);
  options.angle_noise = caps.gimbal_sigma;
  return options;
}

PivotWork::PivotWork(double rod_length, const PivotOptions& options)
    : rod_length_(rod_length), options_(options), swing_(rod_length) {
  Begin(PivotSource::kPresses);
}

void PivotWork::Begin(PivotSource source) {
  source_ = source;
  presses_.clear();
  swing_ = PivotSwing(rod_length_);
  press_.reset();
  refusal_.clear();
  ++generation_;
  fitted_ = 0;
  Fit();
}

void PivotWork::Fit() { found_ = CalibratePivot(poses(), options_, source_); }

std::span<const PivotPress> PivotWork::poses() const noexcept {
  return source_ == PivotSource::kSwing ? swing_.presses() : std::span<const PivotPress>(presses_);
}

void PivotWork::Press() {
  if (source_ != PivotSource::kPresses || press_) return;
  refusal_.clear();
  press_.emplace(rod_length_);
}

void PivotWork::Take(const DeviceSample& sample) {
  const std::uint32_t down = sample.valid ? sample.buttons & ~buttons_ : 0;
  if (sample.valid) {
    buttons_ = sample.buttons;
    last_ = sample;
  }
  if (source_ == PivotSource::kSwing) {
    if (sample.valid) swing_.Add(sample.hip_in_device, sample.handle_in_device);
    return;
  }
  if (down != 0) Press();
  if (!press_) return;
  const bool is_over = sample.valid
                           ? press_->Add(sample.t, sample.hip_in_device, sample.handle_in_device)
                           : press_->Miss();
  if (!is_over) return;
  refusal_ = press_->refusal();
  if (press_->press()) presses_.push_back(*press_->press());
  press_.reset();
  Fit();
}

void PivotWork::SetAngleNoise(double angle_noise) {
  options_.angle_noise = angle_noise;
  ++generation_;
  fitted_ = 0;  // due at once
  if (source_ == PivotSource::kPresses) Fit();
}

std::optional<PivotFit> PivotWork::DueFit() {
  if (source_ != PivotSource::kSwing || poses().size() == fitted_) return {};
  if (fitted_ > 0 && std::abs(last_.t - fitted_at_) < kFitEvery) return {};
  fitted_ = poses().size();
  fitted_at_ = last_.t;
  return PivotFit{{poses().begin(), poses().end()}, options_, generation_};
}

void PivotWork::TakeFit(const PivotFit& fit, const PivotCalibration& found) {
  if (fit.generation == generation_) found_ = found;
}

bool PivotWork::MayBeUsed() const noexcept {
  return !press_ && found_.pivot &&
         (found_.status == PivotStatus::kOk || found_.status == PivotStatus::kOutsideRod);
}

std::optional<double> PivotWork::pressing() const noexcept {
  return press_ ? std::optional(press_->done()) : std::nullopt;
}

double PivotWork::angle() const noexcept {
  if (source_ == PivotSource::kSwing || !last_.valid)
    return std::isfinite(found_.spread) ? found_.spread : 0.0;
  const PivotPress now = PressOf(last_.hip_in_device, last_.handle_in_device, 1.0);
  double least = 1.0;
  for (const PivotPress& press : presses_)
    least =
        std::min(least, std::abs(glm::dot(now.tip - now.hip, press.tip - press.hip)) / rod_length_);
  return std::acos(std::clamp(least, 0.0, 1.0));
}

}  // namespace arthro::simulation

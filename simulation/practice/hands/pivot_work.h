// The calibration of one hand's incision as it goes on: what the device says, sample by sample,
// becomes presses or the poses of a swing, and those a pivot with its predicted error. Pure: no
// thread, no clock, no window. Device frame, m, s.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "simulation/device/device_caps.h"
#include "simulation/device/device_sample.h"
#include "simulation/scope/pivot_calibration.h"
#include "simulation/scope/pivot_swing.h"
#include "simulation/scope/press_average.h"

namespace arthro::simulation {

// The noise of a device, as far as it states it.
PivotOptions PivotOptionsOf(const DeviceCaps& caps);

// A fit of many poses takes longer than a frame, so somebody else does it, beside the window.
struct PivotFit {
  std::vector<PivotPress> poses;
  PivotOptions options;
  int generation = 0;

  PivotCalibration Found() const { return CalibratePivot(poses, options, PivotSource::kSwing); }
};

class PivotWork {
 public:
  static constexpr double kFitEvery = 0.25;  // s

  PivotWork(double rod_length, const PivotOptions& options);

  // From the beginning: by presses, or by swinging.
  void Begin(PivotSource source);
  void Begin() { Begin(source_); }
  // What the device said next; a button of its handle that goes down is a press.
  void Take(const DeviceSample& sample);
  // Now, by a key or a button on the screen; of a swing nothing.
  void Press();
  void SetAngleNoise(double angle_noise);  // rad

  // A swing's fit that is due; its result comes back by TakeFit, and is passed over where all was
  // begun anew meanwhile.
  std::optional<PivotFit> DueFit();
  void TakeFit(const PivotFit& fit, const PivotCalibration& found);

  PivotSource source() const noexcept { return source_; }
  const PivotOptions& options() const noexcept { return options_; }
  std::span<const PivotPress> poses() const noexcept;
  const PivotCalibration& found() const noexcept { return found_; }
  bool MayBeUsed() const noexcept;
  // A press that is being averaged, 0 to 1; none: no press.
  std::optional<double> pressing() const noexcept;
  // Of the press before, empty where it counted.
  const std::string& refusal() const noexcept { return refusal_; }
  // rad: between the rod as it is now and the press that is furthest from it, or of all poses.
  double angle() const noexcept;

 private:
  void Fit();
  double rod_length_;
  PivotOptions options_;
  PivotSource source_ = PivotSource::kPresses;
  std::vector<PivotPress> presses_;
  PivotSwing swing_;
  std::optional<PressAverage> press_;
  std::string refusal_;
  PivotCalibration found_;
  DeviceSample last_;
  std::uint32_t buttons_ = ~0u;  // one that is held from the beginning is no press
  int generation_ = 0;
  std::size_t fitted_ = 0;  // poses
  double fitted_at_ = 0;
};

}  // namespace arthro::simulation

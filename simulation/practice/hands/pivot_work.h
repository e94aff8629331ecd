// A running calibration of one hand's incision. Samples of the device become presses or the poses
// of a swing, and those a pivot with its predicted error. No thread, no clock, no window. Device
// frame, m, s.
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

// Calibration options with the noise that the device states.
PivotOptions PivotOptionsOf(const DeviceCaps& caps);

// A fit of a swing. It takes longer than a frame, so run it beside the window.
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

  // Begins anew, by presses or by a swing.
  void Begin(PivotSource source);
  void Begin() { Begin(source_); }
  // Takes the next sample of the device; a button of the handle that goes down is a press.
  void Take(const DeviceSample& sample);
  // Begins a press, for a key or a button on the screen; ignored during a swing.
  void Press();
  void SetAngleNoise(double angle_noise);  // rad

  // Returns the fit of a swing when it is due. TakeFit takes its result, and ignores it where the
  // calibration was begun anew meanwhile.
  std::optional<PivotFit> DueFit();
  void TakeFit(const PivotFit& fit, const PivotCalibration& found);

  PivotSource source() const noexcept { return source_; }
  const PivotOptions& options() const noexcept { return options_; }
  std::span<const PivotPress> poses() const noexcept;
  const PivotCalibration& found() const noexcept { return found_; }
  bool MayBeUsed() const noexcept;
  // Progress of the present press, 0 to 1; nullopt: no press.
  std::optional<double> pressing() const noexcept;
  // Reason why the last press was refused; empty where it was accepted.
  const std::string& refusal() const noexcept { return refusal_; }
  // Angle in rad between the rod and the press that is furthest from it; during a swing, the spread
  // of all poses.
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
  std::uint32_t buttons_ = ~0u;  // a button that is held from the beginning is no press
  int generation_ = 0;
  std::size_t fitted_ = 0;  // poses
  double fitted_at_ = 0;
};

}  // namespace arthro::simulation

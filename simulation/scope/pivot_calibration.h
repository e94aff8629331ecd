// Calibration of the pivot, the incision in the frame of a device, from presses of its button at
// several handle positions [paper, 3.2]. A press gives the line of the rod; the pivot is the point
// nearest to all lines, by weighted least squares over any number of presses. Device frame, m, rad.
//   M = I − u uᵀ,  A = Σ w M,  p = A⁻¹ Σ w M a;   two lines: the middle of their common
//   perpendicular
// A line with noise s at the pivot, s² = s_p² + (r s_θ)², r = distance from hand to pivot, gives
//   covariance (Σ M / s²)⁻¹,  sigma = √trace; two lines at angle φ: s √(1/2 + 1/(1+cos φ) +
//   1/(1−cos φ))
// An unusable result is no exception: it has a status and a sentence with advice.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "simulation/core/options.h"
#include "simulation/core/units.h"

namespace arthro::simulation {

// Hand and tip of the rod at one press of the button.
struct PivotPress {
  glm::dvec3 hip{0.0}, tip{0.0};
};

struct PivotOptions {
  double position_noise = 0.055e-3;
  double angle_noise = 0.0;
  double min_spread = 8.0 * kRadianPerDegree;
  double max_sigma = 1e-3;
  double residual_limit = 3.0;
  double min_agreement = 0.8;
  int max_trials = 500;
  int seed = 0;

  template <class V>
  void Visit(V&& v) {
    v("position_noise", position_noise, Range{1e-7, 0.01}, "m",
      "Noise of the rig's hand and tip positions, rms along one axis.");
    v("angle_noise", angle_noise, Range{0.0, 5.0 * kRadianPerDegree}, "rad",
      "Noise of the rod's direction where the tip is computed from the handle's angles, rms about "
      "one axis. About 0.1 for encoders, 0.5 to 2 for potentiometers, 0 for a tip that is "
      "measured.");
    v("min_spread", min_spread, Range{1.0 * kRadianPerDegree, 90.0 * kRadianPerDegree}, "rad",
      "Least angle between the two rods that are furthest apart in direction.");
    v("max_sigma", max_sigma, Range{1e-6, 0.1}, "m",
      "A pivot that is predicted to be further off than this (rms) is refused.");
    v("residual_limit", residual_limit, Range{1.0, 100.0}, "",
      "Rods that miss one another by more than this many times what the noise explains are "
      "refused.");
    v("min_agreement", min_agreement, Range{0.5, 1.0}, "",
      "Share of the presses that must agree on one point; the others are left out as outliers.");
    v("max_trials", max_trials, Range{10, 100000}, "",
      "Pairs of presses that are tried as a first guess; all of them where there are fewer.");
    v("seed", seed, Any{}, "", "Start of the random choice of pairs.");
  }
};

enum class PivotStatus {
  kOk,
  kTooFew,        // fewer than two usable presses
  kTooNarrow,     // the rods are too nearly parallel
  kInconsistent,  // they do not meet in one point
  kOutsideRod,    // they meet in one point, but not between hand and tip
};
const char* ToString(PivotStatus status);  // text in pivot.json: "ok", "too_few"…

struct PivotCalibration {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  PivotStatus status = PivotStatus::kTooFew;
  std::string reason;               // a sentence; empty for kOk
  std::optional<glm::dvec3> pivot;  // nullopt with kTooFew and kTooNarrow
  double sigma = kUnknown;          // m, predicted rms error from the larger of noise and residual
  double condition = kUnknown;      // condition number of Σ M; two rods: 1/sin²(φ/2)
  double residual = kUnknown;       // m, rms distance of the rods from the pivot
  double spread = kUnknown;         // rad, largest angle between two rods, 0 to π/2
  int poses_used = 0;
  std::vector<int> left_out;  // indices of outliers and of presses without a direction
};

// Method of gathering the presses, to which the sentences refer.
enum class PivotSource { kPresses, kSwing };

// Computes the pivot. The same presses and options give the same bits. Presses whose hand and tip
// coincide or are not finite are left out.
PivotCalibration CalibratePivot(std::span<const PivotPress> presses,
                                const PivotOptions& options = {},
                                PivotSource source = PivotSource::kPresses);

}  // namespace arthro::simulation

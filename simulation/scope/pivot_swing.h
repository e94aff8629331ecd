// Poses for a pivot calibration from a hand that keeps swinging a rod through the incision, out of
// its device's samples at whatever rate [method.md, Pivot calibration]. Samples of one pose share
// the error of their encoders and count as one, or the calibration would believe itself too well: a
// sample is kept when the hand has moved on by `step` since the one before. Where there are too
// many, each other one goes and the step doubles. Device frame, m.
#pragma once

#include <span>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "simulation/scope/pivot_calibration.h"

namespace arthro::simulation {

// The handle's z runs along the rod, from hand to tip (rod_pose.h).
PivotPress PressOf(const glm::dvec3& hip_in_device, const glm::dquat& handle_in_device,
                   double rod_length) noexcept;

class PivotSwing {
 public:
  static constexpr int kMostPoses = 2000;
  static constexpr double kStep = 1e-3;  // m; twenty quanta of a Touch-class device

  explicit PivotSwing(double rod_length) : rod_length_(rod_length) {}
  // True: it was kept. What is not finite or has no direction is not.
  bool Add(const glm::dvec3& hip_in_device, const glm::dquat& handle_in_device);
  std::span<const PivotPress> presses() const noexcept { return presses_; }

 private:
  double rod_length_, step_ = kStep;
  std::vector<PivotPress> presses_;
};

}  // namespace arthro::simulation

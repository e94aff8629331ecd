// Selects poses for a pivot calibration from the samples of a rod that swings through the incision,
// at any sample rate [method.md, Pivot calibration]. Samples of one pose share the error of their
// encoders; counting each would predict too small an error. A sample is therefore kept when the
// hand has moved by `step` since the last one. Where there are too many, every second one is
// dropped and the step doubles. Device frame, m.
#pragma once

#include <span>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "simulation/scope/pivot_calibration.h"

namespace arthro::simulation {

// Makes a press from a sample; z of the handle points along the rod, from hand to tip (rod_pose.h).
PivotPress PressOf(const glm::dvec3& hip_in_device, const glm::dquat& handle_in_device,
                   double rod_length) noexcept;

class PivotSwing {
 public:
  static constexpr int kMostPoses = 2000;
  static constexpr double kStep = 1e-3;  // m; twenty quanta of a Touch-class device

  explicit PivotSwing(double rod_length) : rod_length_(rod_length) {}
  // Returns true where the sample was kept. Samples that are not finite or have no direction are
  // not.
  bool Add(const glm::dvec3& hip_in_device, const glm::dquat& handle_in_device);
  std::span<const PivotPress> presses() const noexcept { return presses_; }

 private:
  double rod_length_, step_ = kStep;
  std::vector<PivotPress> presses_;
};

}  // namespace arthro::simulation

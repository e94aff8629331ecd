// One press of a pivot calibration: no hand is quite still and no sensor quite sharp, so what
// arrives in a tenth of a second is averaged, and refused, in words, where the hand moved the while
// [method.md, Pivot calibration]. Device frame, m, s.
#pragma once

#include <optional>
#include <string>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "simulation/scope/pivot_calibration.h"

namespace arthro::simulation {

class PressAverage {
 public:
  static constexpr double kDuration = 0.1;     // s
  static constexpr double kMostMotion = 1e-4;  // m, standard deviation of the hand
  static constexpr int kFewest = 4;            // samples; a device at 60 Hz gives six

  explicit PressAverage(double rod_length) : rod_length_(rod_length) {}

  // What the device said at `t`, which rises. True: the press is over.
  bool Add(double t, const glm::dvec3& hip_in_device, const glm::dquat& handle_in_device);
  // The device said nothing. True: the press is over, and refused.
  bool Miss();

  double done() const noexcept { return done_; }  // 0 to 1
  // When it is over: one of the two.
  const std::optional<PivotPress>& press() const noexcept { return press_; }
  const std::string& refusal() const noexcept { return refusal_; }

 private:
  bool Refuse(std::string sentence);
  double rod_length_;
  std::optional<double> began_;
  double done_ = 0;
  int count_ = 0;
  glm::dvec3 mean_{0.0}, direction_{0.0};  // of the hand; sum
  double squares_ = 0;                     // m², of the hand's distances from its mean
  std::optional<PivotPress> press_;
  std::string refusal_;
};

}  // namespace arthro::simulation

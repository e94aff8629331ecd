// One press of a pivot calibration. Hands tremble and sensors are noisy, so the samples of 0.1 s
// are averaged; a press during which the hand moved is refused with a sentence [method.md, Pivot
// calibration]. Device frame, m, s.
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

  // Adds a sample at `t`, which must rise. Returns true when the press is over.
  bool Add(double t, const glm::dvec3& hip_in_device, const glm::dquat& handle_in_device);
  // Reports a missing sample. Returns true: the press is over, and refused.
  bool Miss();

  double done() const noexcept { return done_; }  // 0 to 1
  // After the end, one of these two has a value.
  const std::optional<PivotPress>& press() const noexcept { return press_; }
  const std::string& refusal() const noexcept { return refusal_; }

 private:
  bool Refuse(std::string sentence);
  double rod_length_;
  std::optional<double> began_;
  double done_ = 0;
  int count_ = 0;
  glm::dvec3 mean_{0.0}, direction_{0.0};  // mean of the hand, m; sum of the directions
  double squares_ = 0;  // m², sum of squared distances of the hand from its mean
  std::optional<PivotPress> press_;
  std::string refusal_;
};

}  // namespace arthro::simulation

#include "simulation/scope/press_average.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "simulation/core/units.h"
#include "simulation/scope/pivot_swing.h"

namespace arthro::simulation {

bool PressAverage::Refuse(std::string sentence) {
  done_ = 1;
  refusal_ = std::move(sentence);
  return true;
}

bool PressAverage::Miss() {
  return Refuse("the device did not say where the hand is during the press; press again");
}

bool PressAverage::Add(double t, const glm::dvec3& hip_in_device,
                       const glm::dquat& handle_in_device) {
  const PivotPress sample = PressOf(hip_in_device, handle_in_device, 1.0);
  if (!std::isfinite(t + glm::length(sample.hip) + glm::length(sample.tip))) return Miss();
  if (!began_) began_ = t;
  constexpr double kRounding = 1e-9;  // s, error of a sum of ticks
  done_ = std::clamp((t - *began_ + kRounding) / kDuration, 0.0, 1.0);

  // Running mean and variance [Welford 1962], since the hand is far from the origin of the device.
  ++count_;
  const glm::dvec3 before = sample.hip - mean_;
  mean_ += before / static_cast<double>(count_);
  squares_ += glm::dot(before, sample.hip - mean_);
  direction_ += sample.tip - sample.hip;
  if (done_ < 1.0) return false;

  if (count_ < kFewest)
    return Refuse(
        fmt::format("the device spoke only {} times in {:.0f} ms; check its cable and "
                    "press again",
                    count_, 1e3 * kDuration));
  const double motion = std::sqrt(squares_ / (count_ - 1));
  if (motion > kMostMotion)
    return Refuse(
        fmt::format("the hand moved by {:.2g} mm during the press (limit {:.2g} mm); "
                    "hold the rod still for a moment and press again",
                    MmFromMetres(motion), MmFromMetres(kMostMotion)));
  press_ = PivotPress{mean_, mean_ + rod_length_ * glm::normalize(direction_)};
  return true;
}

}  // namespace arthro::simulation

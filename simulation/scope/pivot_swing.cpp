#include "simulation/scope/pivot_swing.h"

#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

namespace arthro::simulation {

PivotPress PressOf(const glm::dvec3& hip_in_device, const glm::dquat& handle_in_device,
                   double rod_length) noexcept {
  const glm::dvec3 axis = glm::normalize(handle_in_device) * glm::dvec3(0, 0, 1);
  return {hip_in_device, hip_in_device + rod_length * axis};
}

bool PivotSwing::Add(const glm::dvec3& hip_in_device, const glm::dquat& handle_in_device) {
  if (!(glm::dot(handle_in_device, handle_in_device) > 0.0)) return false;
  const PivotPress press = PressOf(hip_in_device, handle_in_device, rod_length_);
  if (!std::isfinite(glm::length(press.hip) + glm::length(press.tip))) return false;
  if (!presses_.empty() && !(glm::length(press.hip - presses_.back().hip) >= step_)) return false;
  presses_.push_back(press);
  if (static_cast<int>(presses_.size()) > kMostPoses) {
    std::vector<PivotPress> half;
    half.reserve(kMostPoses + 1);
    for (std::size_t i = 0; i < presses_.size(); i += 2) half.push_back(presses_[i]);
    presses_ = std::move(half);
    step_ *= 2;
  }
  return true;
}

}  // namespace arthro::simulation

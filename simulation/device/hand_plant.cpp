#include "simulation/device/hand_plant.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "simulation/core/finite.h"

namespace arthro::simulation {
namespace {

constexpr double kLongestStep = 2e-5;  // s

}  // namespace

HandPlant::HandPlant(const PlantOptions& options, const HandModel& hand, const glm::dvec3& at)
    : options_(options), hand_(hand), x_(at), intent_(at) {
  options_.delay = std::clamp(options_.delay, 0, static_cast<int>(kLongestDelay) - 1);
}

void HandPlant::Tick(const glm::dvec3& command, double dt) noexcept {
  glm::dvec3& slot = commands_[tick_ % kLongestDelay];
  slot = IsFinite(command) ? command : glm::dvec3(0.0);
  const double length = glm::length(slot);
  if (length > options_.peak_force) slot *= options_.peak_force / length;
  const glm::dvec3 force =
      commands_[(tick_ + kLongestDelay - static_cast<std::size_t>(options_.delay)) % kLongestDelay];
  ++tick_;
  t_ += dt;

  const double mass = options_.mass + hand_.mass, damping = options_.damping + hand_.damping;
  const int steps = std::max(1, static_cast<int>(std::ceil(dt / kLongestStep - 1e-9)));
  const double h = dt / steps;
  for (int i = 0; i < steps; ++i) {
    // Damping uses the mean velocity of the step, so that the integrator adds no damping.
    const glm::dvec3 push = force + hand_.stiffness * (intent_ - x_);
    glm::dvec3 v = ((mass - 0.5 * h * damping) * v_ + h * push) / (mass + 0.5 * h * damping);
    // Friction stops a motion that it can stop within the step, and slows others.
    const double speed = glm::length(v), slowed = h * options_.friction / mass;
    v = speed > slowed ? v * (1.0 - slowed / speed) : glm::dvec3(0.0);
    const glm::dvec3 way = 0.5 * h * (v_ + v);
    work_ += glm::dot(force, way);
    x_ += way;
    v_ = v;
  }
}

DeviceSample HandPlant::Sample() const noexcept {
  DeviceSample sample;
  sample.t = t_;
  sample.hip_in_device =
      options_.quantum > 0 ? options_.quantum * glm::round(x_ / options_.quantum) : x_;
  sample.valid = true;
  return sample;
}

}  // namespace arthro::simulation

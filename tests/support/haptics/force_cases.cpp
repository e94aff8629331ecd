#include "tests/support/haptics/force_cases.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "tests/support/haptics/paper_kernel.h"

namespace arthro::test {

using namespace simulation;

TouchStroke StrokeUnder(const AnalyticRelief& relief) {
  const glm::dvec2 centre = relief.backdrop.projection.centre_px;
  const double reach = 250.0 / 1024.0 * relief.width;
  TouchStroke stroke;
  for (int i = 0; i < 4000; ++i) {
    const double t = i * kTouchTick;
    const glm::dvec2 p = centre + reach * glm::dvec2(std::sin(1.1 * t) + 0.08 * std::sin(7 * t),
                                                     0.96 * std::sin(1.7 * t + 0.4));
    const double depth = 1e-3 + 0.3e-3 * std::sin(5 * t);
    const glm::dvec3 normal = relief.Normal(p);
    stroke.pixel.push_back(p);
    stroke.tip.push_back(relief.Surface(p) - depth * normal);
    stroke.reference.push_back(kTouchStiffness * depth * normal);
  }
  return stroke;
}

ContactOptions BareContact() {
  ContactOptions options;
  options.stiffness = kTouchStiffness;
  options.damping = options.static_friction = options.sliding_friction = 0.0;
  return options;
}

std::vector<glm::dvec3> ProxyForces(const Surroundings& around, const TouchStroke& stroke) {
  const ContactOptions options = BareContact();
  ContactState state;
  std::vector<glm::dvec3> force;
  force.reserve(stroke.tip.size());
  for (const glm::dvec3& tip : stroke.tip)
    force.push_back(
        TickContact(around, options, kTouchStiffness, {}, tip, kTouchTick, state).force);
  return force;
}

std::vector<glm::dvec3> PaperForces(const Backdrop& backdrop, const DepthMap& map,
                                    const TouchStroke& stroke) {
  std::vector<glm::dvec3> force;
  force.reserve(stroke.tip.size());
  for (const glm::dvec3& tip : stroke.tip) {
    const FieldQuery query = PaperQuery(backdrop, map, tip);
    force.push_back(kTouchStiffness * std::max(0.0, -query.clearance) * query.weight *
                    query.normal);
  }
  return force;
}

ForceErrors ErrorsOf(const std::vector<glm::dvec3>& force,
                     const std::vector<glm::dvec3>& reference) {
  constexpr std::size_t kSettled = 100;  // ticks
  ForceErrors errors;
  double error2 = 0, reference2 = 0;
  std::vector<double> angles;
  for (std::size_t i = kSettled; i < force.size(); ++i) {
    error2 += glm::dot(force[i] - reference[i], force[i] - reference[i]);
    reference2 += glm::dot(reference[i], reference[i]);
    angles.push_back(std::atan2(glm::length(glm::cross(force[i], reference[i])),
                                glm::dot(force[i], reference[i])));
    if (i > kSettled)
      errors.excess_step =
          std::max(errors.excess_step, glm::length(force[i] - force[i - 1]) -
                                           glm::length(reference[i] - reference[i - 1]));
  }
  std::sort(angles.begin(), angles.end());
  errors.rms = std::sqrt(error2 / reference2);
  errors.angle_p99 = angles[angles.size() * 99 / 100];
  errors.angle_max = angles.back();
  return errors;
}

}  // namespace arthro::test

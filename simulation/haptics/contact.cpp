#include "simulation/haptics/contact.h"

#include <algorithm>
#include <numbers>

#include <glm/geometric.hpp>

namespace arthro::simulation {
namespace {

constexpr double kNoPush = 1e-12;  // m

// Where the proxy is drawn to: under itself as far as friction holds it, else to the edge of the
// friction cone. True: it sticks.
bool Grip(const ContactOptions& options, const ContactState& state, const glm::dvec3& tip,
          glm::dvec3& goal) noexcept {
  goal = tip;
  const glm::dvec3 pull = state.proxy.position - tip;
  const double push = glm::dot(pull, state.normal);
  if (!(push > kNoPush)) return false;
  const glm::dvec3 along = pull - push * state.normal;
  const double lag = glm::length(along);
  if (lag <= options.static_friction * push) return true;
  const double sliding = std::min(options.sliding_friction, options.static_friction);
  goal = tip + along * (sliding * push / lag);
  return false;
}

}  // namespace

ContactForce TickContact(const Surroundings& surroundings, const ContactOptions& options,
                         double stiffness, const glm::dvec3& portal, const glm::dvec3& tip,
                         double dt, ContactState& state) noexcept {
  const double radius = options.tip_radius;
  const bool is_first = !state.has_started;
  if (is_first) {
    state = ContactState{};
    state.has_started = true;
    state.proxy.position = portal;
    state.tip = tip;
  }
  // First-order low pass of the difference; the step in time is the true one.
  if (dt > 0.0) {
    const double x = 2.0 * std::numbers::pi * options.velocity_cutoff * dt;
    state.velocity += x / (1.0 + x) * ((tip - state.tip) / dt - state.velocity);
  }

  // Move the proxy, unless friction holds it.
  glm::dvec3 goal;
  if (!Grip(options, state, tip, goal)) {
    const double travel = glm::length(tip - state.tip) + 2.0 * surroundings.field.pixel_size();
    MoveProxy(surroundings, radius, goal, travel, state.proxy);
  }
  state.tip = tip;

  // What holds it there, and how hard each.
  ContactForce result;
  const PlaneSet planes = PlanesAt(surroundings, radius, tip, state.proxy);
  const glm::dvec3& proxy = state.proxy.position;
  state.normal = glm::dvec3(0.0);
  if (planes.count == 0) return result;
  const NearestFree free = NearestPoint(planes, tip, proxy);
  glm::dvec3 push(0.0), weighted(0.0);
  double most = 0.0;
  for (int i = 0; i < planes.count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    push += free.push[k] * planes.plane[k].normal;
    weighted += planes.plane[k].weight * free.push[k] * planes.plane[k].normal;
    if (planes.plane[k].weight * free.push[k] <= most) continue;
    most = planes.plane[k].weight * free.push[k];
    result.contact = planes.plane[k].contact;
  }
  const double depth = glm::length(push);
  if (!(depth > kNoPush) || result.contact < 0) {
    result.contact = -1;
    return result;
  }
  state.normal = push / depth;
  result.penetration = depth;
  result.force = stiffness * weighted;
  const double share = glm::length(weighted) / depth;  // what the fade leaves

  // Friction: what the proxy lags behind, within the cone.
  const glm::dvec3 lag = proxy - free.nearest;
  const double lag_length = glm::length(lag);
  if (lag_length > kNoPush) {
    const double limit = options.static_friction * depth;
    result.force += stiffness * share * std::min(1.0, limit / lag_length) * lag;
  }

  const double approach = glm::dot(state.velocity, state.normal);
  if (approach < 0.0 && options.stiffness > 0.0) {
    const double b = options.damping * stiffness / options.stiffness * share *
                     std::min(1.0, depth / options.damping_onset);
    result.force -= b * approach * state.normal;
  }
  return result;
}

}  // namespace arthro::simulation

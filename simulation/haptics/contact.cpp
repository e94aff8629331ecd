#include "simulation/haptics/contact.h"

#include <algorithm>
#include <numbers>

#include <glm/geometric.hpp>

namespace arthro::simulation {
namespace {

// A proxy nearer to its tip than this counts as at the tip; 10 µN.
constexpr double kAtTip = 2e-8;  // m

// Curvature turns the normal by about 1° per pixel; at a depth of 1 mm that is a fifth of a pixel.
constexpr double kKink = 0.2;  // pixels

// Rise time of the force of a tip that enters the known region from below a surface; the proxy
// itself arrives in a few ticks.
constexpr double kFadeIn = 0.010;  // s

// A tool may hook behind an edge and pull. At this distance the coupling of 500 N/m pulls with 4 N,
// more than the devices of that stiffness give.
constexpr double kFarOff = 8e-3;      // m
constexpr double kCaughtFor = 0.050;  // s; a hand that reverses its motion stays for less
constexpr double kLetGo = 0.100;      // s

// Reduces the force of a caught proxy. At 0 the proxy is moved to its tip.
void LetGoIfCaught(const Surroundings& surroundings, double radius, const glm::dvec3& portal,
                   const glm::dvec3& tip, double dt, ContactState& state) noexcept {
  const bool is_caught = glm::length(state.proxy.position - tip) > kFarOff &&
                         IsWayFree(surroundings, radius, portal, tip);
  state.caught = is_caught ? state.caught + dt : std::max(0.0, state.caught - dt);
  if (!is_caught && !(state.caught > kCaughtFor)) state.caught = 0.0;
  const double left = std::clamp(1.0 - (state.caught - kCaughtFor) / kLetGo, 0.0, 1.0);
  state.hold = left * left;
  state.was_let_go = !(left > 0.0);
  if (!state.was_let_go) return;
  state.proxy = Proxy{};
  state.proxy.position = tip;
  state.caught = 0.0;
}

// Computes the goal of the proxy: below itself while friction holds it, else at the edge of the
// friction cone. Returns true where it sticks.
bool Grip(const ContactOptions& options, const ContactState& state, const glm::dvec3& tip,
          glm::dvec3& goal) noexcept {
  goal = tip;
  const glm::dvec3 pull = state.proxy.position - tip;
  const double push = glm::dot(pull, state.normal);
  if (!(push > kAtTip)) return false;
  const glm::dvec3 along = pull - push * state.normal;
  const double lag = glm::length(along);
  if (lag <= options.static_friction * push) {
    goal = tip + along;
    return true;
  }
  const double sliding = std::min(options.sliding_friction, options.static_friction);
  goal = tip + along * (sliding * push / lag);
  return false;
}

// Returns the push of the surfaces from the goal to the foot of their planes. Writes the surface
// that pushes most and the factor of the fade to `state`. The interpolated normals of a relief turn
// smoothly, while its height has a faint kink at every pixel, in which the proxy rests; using the
// foot avoids it. A foot further from the proxy means a crease that the planes do not represent, or
// a proxy that is still moving; then the proxy itself is used.
glm::dvec3 PushOf(const PlaneSet& planes, const glm::dvec3& goal, double kink, double dt,
                  ContactState& state) noexcept {
  const bool is_new = state.contact < 0;
  const glm::dvec3& proxy = state.proxy.position;
  const NearestFree free = NearestPoint(planes, goal, proxy);
  double sum = 0.0, weighted = 0.0, most = -1.0;
  for (int i = 0; i < planes.count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double push = planes.plane[k].weight * free.push[k];
    sum += free.push[k];
    weighted += push;
    if (push <= most) continue;
    most = push;
    state.contact = planes.plane[k].contact;
  }
  if (planes.count > 0) {
    const double share = sum > 0.0 ? weighted / sum : planes.plane[0].weight;
    state.share = is_new ? share : std::min(share, state.share + dt / kFadeIn);
  }
  const glm::dvec3 rest = proxy - free.nearest;
  const double length = glm::length(rest);
  return free.nearest - goal + (length > kink ? 1.0 - kink / length : 0.0) * rest;
}

// Damping force against the approach, which sets in over the onset depth.
glm::dvec3 Viscosity(const ContactOptions& options, double stiffness, const glm::dvec3& velocity,
                     const glm::dvec3& normal, double share, double depth) noexcept {
  const double approach = glm::dot(velocity, normal);
  if (!(approach < 0.0) || !(options.stiffness > 0.0)) return glm::dvec3(0.0);
  const double b = options.damping * stiffness / options.stiffness * share *
                   std::min(1.0, depth / options.damping_onset);
  return -b * approach * normal;
}

}  // namespace

ContactForce TickContact(const Surroundings& surroundings, const ContactOptions& options,
                         double stiffness, const glm::dvec3& portal, const glm::dvec3& tip,
                         double dt, ContactState& state, const TissuePull& tissue) noexcept {
  const double radius = options.tip_radius;
  const bool is_pulled = tissue.force != glm::dvec3(0.0) && options.stiffness > 0.0;
  const glm::dvec3 shift = is_pulled ? tissue.force / options.stiffness : glm::dvec3(0.0);
  const glm::dvec3 held = is_pulled ? tip + shift : tip;
  const bool is_first = !state.has_started;
  if (is_first) {
    state = ContactState{};
    state.has_started = true;
    state.proxy.position = portal;
    state.tip = tip;
    state.held = held;
  }
  // First-order low pass of the difference; the step in time is the true one.
  if (dt > 0.0) {
    const double x = 2.0 * std::numbers::pi * options.velocity_cutoff * dt;
    state.velocity += x / (1.0 + x) * ((tip - state.tip) / dt - state.velocity);
  }

  // Move the proxy, unless friction holds it.
  glm::dvec3 goal;
  const bool sticks = Grip(options, state, held, goal);
  if (!sticks || !IsFree(surroundings, radius, state.proxy)) {
    const double travel = glm::length(held - state.held) + 2.0 * surroundings.field.pixel_size();
    MoveProxy(surroundings, radius, goal, travel, state.contact < 0, state.proxy);
  }
  // Tissue holds the tip by a force of its own.
  if (is_pulled && !tissue.is_free)
    state.caught = 0.0, state.hold = 1.0, state.was_let_go = false;
  else
    LetGoIfCaught(surroundings, radius, portal, tip, dt, state);
  if (state.proxy.position == tip) goal = tip;
  state.tip = tip;
  state.held = held;

  // Adds the force of the tissue, independent of the surfaces.
  ContactForce result;
  if (is_pulled) {
    result.contact = tissue.contact;
    result.penetration = glm::length(shift);
    result.force = stiffness * shift +
                   Viscosity(options, stiffness, state.velocity, tissue.normal, 1.0, tissue.depth);
    result.force *= state.hold;
  }
  // Finds the planes that hold the proxy away from the goal, and their push.
  const auto leave = [&state]() noexcept {
    state.normal = glm::dvec3(0.0);
    state.share = 0.0;
    state.contact = -1;
  };
  if (!(glm::length(state.proxy.position - goal) > kAtTip)) return leave(), result;
  const PlaneSet planes = PlanesAt(surroundings, radius, goal, state.proxy);
  const glm::dvec3 push = PushOf(planes, goal, kKink * surroundings.field.pixel_size(), dt, state);
  const double depth = glm::length(push);
  if (!(depth > 0.0)) return leave(), result;
  state.normal = planes.count > 0 ? push / depth : glm::dvec3(0.0);
  const glm::dvec3 of_surfaces = stiffness * state.share * state.hold * (push + (goal - held));
  if (!is_pulled) {
    result.contact = state.contact;
    result.penetration = depth;
    result.force = of_surfaces;
  } else {
    if (glm::length(of_surfaces) > glm::length(result.force)) result.contact = state.contact;
    result.penetration = glm::length(push + shift);
    result.force += of_surfaces;
  }

  result.force += Viscosity(options, stiffness, state.velocity, state.normal, state.share, depth);
  return result;
}

}  // namespace arthro::simulation

// Force of the surfaces on a tip: a virtual coupling to its proxy, viscous along the normal while
// approaching, with Coulomb friction as stick and slip of the proxy. Friction does not use
// velocity, so the proxy does not drift.
//   F = w k (proxy − tip) − w b min(v·n, 0) n
// Deformable tissue adds a force F of its own model. The goal of the proxy is then the equilibrium
// of that force and the spring, tip + F/k, instead of the tip. The backdrop keeps the proxy
// outside, and k (proxy − tip) is the sum of both forces, so nothing is counted twice. Per tick the
// proxy moves by at most the motion of the tip and two pixels, which bounds each step of the force
// by k times that.
// A proxy can slip behind an edge while its tip passes through the surface, and stay there when the
// tip comes back. It is released when the rod from the portal to the tip crosses no surface and the
// proxy is further from the tip than any device can hold. Its force then falls to zero within 0.15
// s.
// Portal frame, m, N, s; noexcept, allocates nothing [method.md, Backdrop force].
#pragma once

#include "simulation/core/options.h"
#include "simulation/haptics/proxy.h"

namespace arthro::simulation {

struct ContactOptions {
  // Stability bound: 781 N/m with one tick of delay, b = 0.2 + 1 Ns/m and nobody holding the device
  // [method.md, Stability].
  double stiffness = 500.0;
  double damping = 1.0;
  // Two quanta of a Touch-class device (0.055 mm); damping that sets in at once would rattle.
  double damping_onset = 1e-4;
  // Steel on wet cartilage, boundary lubrication: 0.01 to 0.05.
  double static_friction = 0.03;
  double sliding_friction = 0.02;
  double tip_radius = 0.0;         // the tip of the paper is a point
  double velocity_cutoff = 150.0;  // Hz; usual values are 100 to 200
  template <class V>
  void Visit(V&& v) {
    v("stiffness", stiffness, Range{10, 3000}, "N/m",
      "Stiffness of the coupling of tip and proxy.");
    v("damping", damping, Range{0, 10}, "N s/m", "Viscosity along the normal while approaching.");
    v("damping_onset", damping_onset, Range{1e-6, 1e-2}, "m",
      "Penetration at which the viscosity reaches its full value.");
    v("static_friction", static_friction, Range{0, 2}, "", "Coulomb coefficient at rest.");
    v("sliding_friction", sliding_friction, Range{0, 2}, "", "Coulomb coefficient in motion.");
    v("tip_radius", tip_radius, Range{0, 5e-3}, "m", "Radius of the ball at the tip.");
    v("velocity_cutoff", velocity_cutoff, Range{10, 1000}, "Hz",
      "First-order filter of the tip's velocity.");
  }
};

struct ContactState {
  bool has_started = false;  // false: the tip enters through its portal in the next tick
  Proxy proxy;
  glm::dvec3 tip{0.0}, velocity{0.0};
  glm::dvec3 held{0.0};  // tip, moved by the force of deformable tissue
  // Last tick: unit normal of the force (zero: no force), factor of the fade, and the surface in
  // contact.
  glm::dvec3 normal{0.0};
  double share = 0;
  int contact = -1;
  // A caught proxy: time since it was caught, s, and remaining factor of its force, 1 to 0.
  double caught = 0, hold = 1;
  bool was_let_go = false;  // released in the last tick: the proxy is at its tip, without contact
};

// Force of tissue that is not among the surroundings.
struct TissuePull {
  glm::dvec3 force{0.0};  // on the tip, by a spring of options.stiffness between tip and proxy
  int contact = -1;       // 1 + i of the tissue with the largest share
  // Normal of the tissue where it is viscous while the tip approaches; zero: not viscous.
  glm::dvec3 normal{0.0};  // unit
  double depth = 0;        // m
  bool is_free = false;    // a tool coming straight from its portal would not touch it
};

struct ContactForce {
  glm::dvec3 force{0.0};   // on the tip
  double penetration = 0;  // m, of the tip below the surfaces
  int contact = -1;        // surface with the largest share: -1 none, 0 backdrop, 1 + i mesh i
};

// Computes the force of one tick. `portal` is the entry of the tool. `stiffness` is
// options.stiffness or less (lever.h); damping and tissue force are lowered with it.
ContactForce TickContact(const Surroundings& surroundings, const ContactOptions& options,
                         double stiffness, const glm::dvec3& portal, const glm::dvec3& tip,
                         double dt, ContactState& state, const TissuePull& tissue = {}) noexcept;

}  // namespace arthro::simulation

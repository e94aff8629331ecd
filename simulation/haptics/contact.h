// The force of the surfaces on a tip: a virtual coupling to its proxy, viscous along the normal
// while approaching, with Coulomb friction as stick and slip of the proxy (no velocity in it, so no
// drift).
//   F = w k (proxy − tip) − w b min(v·n, 0) n
// Living tissue holds the tip too, by a force that its own model gives: the proxy's goal is then
// not the tip but the place where that force meets the spring, tip + F/k. The backdrop holds the
// proxy out of itself, and k (proxy − tip) is the force of both: nothing is counted twice. The
// proxy moves by no more than the tip and two pixels a tick, so k times that bounds each step.
// A proxy can slip behind an edge while its tip goes through the surface, and stay there when the
// tip comes back. It is let go where the rod from the portal to the tip crosses no surface, and the
// proxy is further from the tip than any device holds: its force then falls to zero within 0.15 s.
// Portal frame, m, N, s; noexcept, allocates nothing [method.md, Backdrop force].
#pragma once

#include "simulation/core/options.h"
#include "simulation/haptics/proxy.h"

namespace arthro::simulation {

struct ContactOptions {
  // Bound 781 N/m with one tick of delay, b = 0.2 + 1 Ns/m and nobody holding the device
  // [method.md, Stability].
  double stiffness = 500.0;
  double damping = 1.0;
  // Two quanta of a Touch-class device (0.055 mm): damping that begins at once would rattle.
  double damping_onset = 1e-4;
  // Steel on wet cartilage, boundary lubrication: 0.01 to 0.05.
  double static_friction = 0.03;
  double sliding_friction = 0.02;
  double tip_radius = 0.0;         // the paper's tip is a point
  double velocity_cutoff = 150.0;  // notes 4.2: 100 to 200 Hz
  template <class V>
  void Visit(V&& v) {
    v("stiffness", stiffness, Range{10, 3000}, "N/m",
      "Stiffness of the coupling of tip and proxy.");
    v("damping", damping, Range{0, 10}, "N s/m", "Viscosity along the normal while approaching.");
    v("damping_onset", damping_onset, Range{1e-6, 1e-2}, "m",
      "Penetration at which the viscosity is fully there.");
    v("static_friction", static_friction, Range{0, 2}, "", "Coulomb coefficient at rest.");
    v("sliding_friction", sliding_friction, Range{0, 2}, "", "Coulomb coefficient in motion.");
    v("tip_radius", tip_radius, Range{0, 5e-3}, "m", "Radius of the tip's ball.");
    v("velocity_cutoff", velocity_cutoff, Range{10, 1000}, "Hz",
      "First-order filter of the tip's velocity.");
  }
};

struct ContactState {
  bool has_started = false;  // false: the tip enters through its portal at the next tick
  Proxy proxy;
  glm::dvec3 tip{0.0}, velocity{0.0};
  glm::dvec3 held{0.0};  // the tip, or where tissue holds it
  // Of the last tick: unit normal of the force (zero: there was none), what the fade left of it,
  // and whose it was.
  glm::dvec3 normal{0.0};
  double share = 0;
  int contact = -1;
  // A caught proxy: for how long it was, s, and the share that is left of its force, 1 to 0.
  double caught = 0, hold = 1;
  bool was_let_go = false;  // in the last tick: it is at its tip, and nothing holds it
};

// What tissue that is not among the surroundings does.
struct TissuePull {
  glm::dvec3 force{0.0};  // on the tip, of a spring of options.stiffness between tip and proxy
  int contact = -1;       // 1 + i of the tissue that gives most of it
  // What is viscous while the tip approaches it, as a surface; zero: nothing is.
  glm::dvec3 normal{0.0};  // unit
  double depth = 0;        // m
  bool is_free = false;    // a tool that came straight from its portal would not be held by it
};

struct ContactForce {
  glm::dvec3 force{0.0};   // on the tip
  double penetration = 0;  // of the tip below the surfaces
  int contact = -1;        // of the surface that carries most: -1 none, 0 backdrop, 1 + i mesh i
};

// `portal` is where the tool enters; `stiffness` is options.stiffness or less (lever.h), and lowers
// the damping and the tissue's force with it.
ContactForce TickContact(const Surroundings& surroundings, const ContactOptions& options,
                         double stiffness, const glm::dvec3& portal, const glm::dvec3& tip,
                         double dt, ContactState& state, const TissuePull& tissue = {}) noexcept;

}  // namespace arthro::simulation

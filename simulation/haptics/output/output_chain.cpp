#include "simulation/haptics/output/output_chain.h"

#include <cmath>

#include <glm/geometric.hpp>

#include "simulation/core/finite.h"

namespace arthro::simulation {

LimitedForce ForceToHand(const OutputOptions& options, const TipForce& tip, double dt,
                         OutputState& state) noexcept {
  Fault fault = tip.fault;
  const glm::dvec3 bare = HandForce(tip.lever, tip.force);
  if (fault == Fault::kNone && !(IsFinite(bare) && std::isfinite(tip.hand_speed)))
    fault = Fault::kNotFinite;
  if (fault == Fault::kNone && tip.push == HandPush::kNo) fault = Fault::kNotArmed;

  LimiterOptions limiter = options.limiter;
  limiter.max_force = ThermalClamp(options.thermal, limiter.max_force, state.thermal);
  glm::dvec3 force = bare;
  if (fault != Fault::kNone) {
    state.guard = PassivityState{};
  } else {
    // The lever changes forces by its gain and stiffnesses by its square, but no energies: the
    // spring at the hand stores the same energy, less where it fades.
    const double at_tip = glm::dot(tip.force, tip.force), at_hand = glm::dot(bare, bare);
    const double stiffness = at_tip > 0 ? tip.stiffness * (at_hand / at_tip) : tip.stiffness;
    if (tip.is_elastic) {
      const HandSpring spring{tip.lever.fade > 0 ? stiffness / tip.lever.fade : 0.0,
                              limiter.max_force};
      force = BoundByCredit(options.passivity, force, tip.hand, spring, state.limiter.ramp < 1.0,
                            dt, state.guard);
    } else {
      state.guard.has_credit = false;
    }
    force = GuardPassivity(options.passivity, force, tip.hand, stiffness, dt, state.guard);
  }

  LimitedForce sent;
  if (fault == Fault::kNone && tip.push == HandPush::kPause) {
    state.limiter.held = glm::dvec3(0.0);
  } else {
    sent = LimitForce(limiter, force, tip.hand_speed, fault, dt, state.limiter);
  }
  NoteSent(sent.force, state.guard);
  NoteHeat(options.thermal, glm::length(sent.force), dt, state.thermal);
  return sent;
}

}  // namespace arthro::simulation

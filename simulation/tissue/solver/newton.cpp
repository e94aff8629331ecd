#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>

#include "simulation/tissue/solver/conjugate_gradients.h"
#include "simulation/tissue/solver/implicit_solver_impl.h"

namespace arthro::simulation {
namespace {

// Residual above which inverted elements are recovered; below it they are an answer to the load.
constexpr double kFarFromRest = 0.2;
constexpr int kFollowingIterations = 300;
constexpr double kAsleep = 1e-4;  // fraction of the tolerance below which a step does nothing
// Relative accuracy of a direction far from equilibrium: a tenth of the residual [Eisenstat &
// Walker 1996].
constexpr double kForcing = 0.1;
// Relative accuracy in energy beyond which only the residual goal counts.
constexpr double kEnergy = 0.03;
constexpr int kManyIterations = 8;  // count that requests a new factor, where one may be made
// Iterations that cost as much as a new factor: a system unsolved by then gets one and starts
// again.
constexpr int kIterationsOfAFactor = 36;
// Iterations that cost as much as the energy, forces and tangent of a Newton iteration, and as the
// rounds of one that recovers.
constexpr int kIterationsOfATangent = 16, kIterationsOfARecovery = 36;
constexpr int kFewestIterations = 6;  // least for a system, however much work is done already

}  // namespace

void ImplicitSolver::Impl::Evaluate(std::span<const glm::dvec3> x, Law law, Tangent tangent) {
  const bool is_known = is_evaluated && at_law == law &&
                        (tangent == Tangent::kNone || at_tangent == tangent) &&
                        std::equal(x.begin(), x.end(), at.begin());
  if (is_known) return;
  assembly =
      model->Assemble(x, law, tangent, force, tangent == Tangent::kNone ? nullptr : &stiffness);
  std::copy(x.begin(), x.end(), at.begin());
  at_law = law;
  at_tangent = tangent;
  is_evaluated = true;
}

void ImplicitSolver::Impl::SetSprings(std::span<const glm::dvec3> x, bool renews_friction) {
  simulation::SetSprings(contacts, x, renews_friction, at_tangent == Tangent::kTrue, pressing,
                         holds, springs);
}

// Returns the value at the last evaluation; `magnitude` is the sum of the absolute values of its
// terms, for the rounding error.
double ImplicitSolver::Impl::Potential(std::span<const glm::dvec3> x, const Problem& problem,
                                       double& magnitude) {
  double work = 0, inertia = 0;
  for (std::size_t i = 0; i < x.size(); ++i) work += glm::dot(problem.load[i], x[i] - begin_x[i]);
  work *= problem.load_share;
  if (problem.dt > 0)
    for (std::size_t i = 0; i < x.size(); ++i) {
      const glm::dvec3 off = (x[i] - goal_x[i]) * is_free[i];
      inertia += 0.5 * added[i] * glm::dot(off, off);
    }
  const double contact = SpringEnergy(springs, holds);
  magnitude = std::abs(assembly.energy) + std::abs(work) + inertia + contact;
  return assembly.energy - work + inertia + contact;
}

// Computes `gradient`, 0 at fixed axes, and returns the reference size for residuals.
double ImplicitSolver::Impl::Gradient(std::span<const glm::dvec3> x, const Problem& problem) {
  double inertia = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    gradient[i] = -force[i] - problem.load_share * problem.load[i];
    if (problem.dt > 0) {
      const glm::dvec3 pull = added[i] * (x[i] - goal_x[i]) * is_free[i];
      inertia += glm::dot(pull, pull);
      gradient[i] += pull;
    }
  }
  double pressed = 0;
  for (const ContactSpring& spring : springs) {
    const ContactPoint& contact = *spring.contact;
    for (int i = 0; i < contact.count; ++i)
      gradient[contact.node[i]] -= contact.weight[i] * spring.force;
    pressed += glm::dot(spring.force, spring.force);
  }
  double loaded = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    gradient[i] *= is_free[i];
    const glm::dvec3 load = problem.load_share * problem.load[i] * is_free[i];
    loaded += glm::dot(load, load);
  }
  return std::max(
      {std::sqrt(inertia), std::sqrt(pressed), std::sqrt(loaded), Norm(force), least_force});
}

LinearSystem ImplicitSolver::Impl::System() const {
  return {&stiffness, last_dt > 0 ? std::span<const double>(added) : std::span<const double>(),
          springs, holds, is_free};
}

// Computes the Newton step in `direction`, including the prescribed motion (`lead`) of fixed axes.
void ImplicitSolver::Impl::FindDirection(std::span<const glm::dvec3> x, const Problem& problem,
                                         const NewtonGoal& goal, double scale, double residual,
                                         bool leads, StepReport& report) {
  const bool is_static = problem.dt == 0;
  CgGoal linear;
  linear.relative = is_static ? std::clamp(0.1 * residual, 1e-7, 1e-2) : kEnergy;
  linear.residual = is_static ? 0.0 : std::max(0.5 * goal.tolerance, kForcing * residual) * scale;
  int most = goal.max_iterations;
  if (goal.follows) {
    // In an indefinite system the energy norm of the error is meaningless, and plain Newton needs
    // its whole step.
    linear.takes_saddles = true;
    most = std::min(most, kFollowingIterations);
    linear.relative = 1e-5;
    linear.residual = 1e-5 * residual * scale;
  }
  model->NodeRotations(x, rotation);
  const bool begins_anew = needs_factor || (goal.refactors && wants_factor);
  const auto factor_now = [&] { report.work += kIterationsOfAFactor * FactorNow(x, goal.follows); };
  if (begins_anew) factor_now();
  wants_factor = needs_factor = false;
  bool may_factor = !begins_anew && report.work + 2 * kIterationsOfAFactor < goal.max_work;
  for (int attempt = 0; attempt < 3; ++attempt) {
    const LinearSystem system = System();
    for (std::size_t i = 0; i < x.size(); ++i) right[i] = -gradient[i];
    if (leads) {
      system.Apply(lead, direction);
      for (std::size_t i = 0; i < x.size(); ++i) right[i] -= direction[i];
    }
    factor->SetCurrentRotations(rotation);
    factor->SetDiagonal(stiffness, system.added);
    linear.max_iterations =
        std::min(most, std::max(goal.max_work - report.work, kFewestIterations));
    if (may_factor && !goal.refactors)
      linear.max_iterations = std::min(linear.max_iterations, kIterationsOfAFactor);
    const CgResult result = SolveByGradients(system, *factor, right, linear, vectors, direction);
    report.iterations += result.iterations;
    report.work += result.iterations;
    wants_factor = wants_factor || result.iterations > kManyIterations;
    met_negative = met_negative || !result.is_positive;
    if (!result.is_positive && !goal.follows) {
      // The direction found so far is still a descent; the projected tangent gives a whole step.
      projected_left = kProjectedIterations;
      if (at_tangent == Tangent::kProjected) break;
      Evaluate(x, at_law, Tangent::kProjected);
    } else if (result.converged || !may_factor) {
      break;
    } else {
      factor_now();
      may_factor = false;
    }
  }
  if (leads)
    for (std::size_t i = 0; i < x.size(); ++i) direction[i] += lead[i];
}

// Moves along `direction` as far as the potential falls [Armijo 1966]. Evaluates the whole step
// with its tangent, since it is nearly always taken. Returns false if no step falls.
bool ImplicitSolver::Impl::SearchAlong(std::span<glm::dvec3> x, const Problem& problem, Law law,
                                       Tangent tangent) {
  constexpr double kArmijo = 1e-4;
  constexpr int kMostHalvings = 30;
  double magnitude = 0;
  const double before = Potential(x, problem, magnitude);
  const double slope = Dot(gradient, direction);
  const double noise = energy_noise + 1e-13 * magnitude;
  if (!(slope < 0)) return false;
  // Resets the tools for each trial: a step that was too long may have left its tool on the other
  // side of the tissue.
  std::array<glm::dvec3, kMostTools> offset;
  for (std::size_t h = 0; h < holds.size(); ++h) offset[h] = holds[h].offset;
  const auto put_back = [&] {
    for (std::size_t h = 0; h < holds.size(); ++h) holds[h].offset = offset[h];
  };
  double step = 1;
  for (int halving = 0; halving < kMostHalvings; ++halving) {
    for (std::size_t i = 0; i < x.size(); ++i) trial[i] = x[i] + step * direction[i];
    put_back();
    Evaluate(trial, law, halving == 0 ? tangent : Tangent::kNone);
    SetSprings(trial, false);
    const double after = Potential(trial, problem, magnitude);
    if (after <= before + kArmijo * step * slope + noise) {
      std::copy(trial.begin(), trial.end(), x.begin());
      return true;
    }
    // Goes to the minimum of the parabola through both values and the slope.
    const double rise = after - before - step * slope;
    const double lowest = std::isfinite(rise) && rise > 0 ? -0.5 * slope * step * step / rise : 0;
    step = std::clamp(lowest, 0.1 * step, 0.5 * step);
  }
  put_back();
  return false;
}

StepReport ImplicitSolver::Impl::Newton(std::span<glm::dvec3> x, const Problem& problem,
                                        const NewtonGoal& goal) {
  StepReport report;
  const Law own = model->material().law;
  bool leads = false;
  if (!problem.target.empty())
    for (std::size_t i = 0; i < x.size(); ++i) {
      lead[i] = problem.target_share * (problem.target[i] - x[i]) * (glm::dvec3(1.0) - is_free[i]);
      leads = leads || glm::dot(lead[i], lead[i]) > 0;
    }
  int stuck = 0;
  met_negative = false;
  was_refitted = false;
  while (true) {
    const Tangent tangent =
        projected_left > 0 && !goal.follows ? Tangent::kProjected : Tangent::kTrue;
    Evaluate(x, own, tangent);
    if (assembly.inverted == 0) has_given_up = false;
    SetSprings(x, true);
    const double scale = Gradient(x, problem);
    const double residual = Norm(gradient) / scale;
    report.residual = residual;
    report.inverted = assembly.inverted;
    report.energy = assembly.energy;
    const bool is_far = assembly.inverted > 0 && !has_given_up && residual > kFarFromRest;
    const bool may_go_on = report.newton < goal.max_newton && report.work < goal.max_work;
    if (is_far && goal.follows) return report;  // diverged: a smaller load step may converge
    if ((is_far || is_recovering) && may_go_on && std::isfinite(residual)) {
      // After a cut its factor is new, and takes a step of its own.
      constexpr int kAnew = kIterationsOfAFactor + kIterationsOfATangent + kIterationsOfARecovery;
      if (!recovery_factor && report.newton > 0 && report.work + kAnew > goal.max_work)
        return report;
      // Recovers inverted elements until none is left.
      report.used_fallback = true;
      report.newton += 1;
      report.work += kIterationsOfARecovery;
      for (std::size_t i = 0; i < x.size() && leads; ++i) x[i] += lead[i];
      leads = false;
      if (!recovery_factor) {  // after a cut
        MakeRecovery();
        report.work += kIterationsOfAFactor + kIterationsOfATangent;
      }
      RecoverShape(x, problem);
      continue;
    }
    if (!std::isfinite(residual) || !std::isfinite(assembly.energy)) {
      report.is_finite = false;
      return report;
    }
    const bool is_rounding = Norm(gradient) <= force_noise;
    const bool is_free_to_end = !leads && !is_recovering;
    report.converged = (residual <= goal.tolerance || is_rounding) && is_free_to_end;
    // A step that starts near equilibrium does nothing. Others take at least one Newton iteration,
    // so that a settling body comes far closer than the tolerance of one step.
    const double enough =
        problem.dt > 0 && report.newton == 0 ? kAsleep * goal.tolerance : goal.tolerance;
    if ((residual <= enough || is_rounding) && is_free_to_end) return report;
    if (!may_go_on || stuck > 2) return report;
    if (met_negative && !goal.follows && report.newton > goal.patience) return report;
    ++report.newton;
    report.work += kIterationsOfATangent;
    FindDirection(x, problem, goal, scale, residual, leads, report);
    const Tangent used = at_tangent;
    projected_left = std::max(0, projected_left - 1);
    if (leads || goal.follows) {
      // Prescribed motions are applied in full, whatever they cost.
      for (std::size_t i = 0; i < x.size(); ++i) {
        x[i] += direction[i];
        if (leads && problem.target_share == 1)  // exact
          x[i] += (glm::dvec3(1.0) - is_free[i]) * (problem.target[i] - x[i]);
      }
      leads = false;
    } else if (SearchAlong(x, problem, own, used)) {
      stuck = 0;
    } else {
      ++stuck;
      projected_left = kProjectedIterations;
    }
  }
}

}  // namespace arthro::simulation

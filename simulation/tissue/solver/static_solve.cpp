#include <algorithm>
#include <cmath>

#include "simulation/core/error.h"
#include "simulation/tissue/solver/conjugate_gradients.h"
#include "simulation/tissue/solver/implicit_solver_impl.h"

namespace arthro::simulation {
namespace {

constexpr int kNewtonWhole = 60;      // iterations before the load is applied in steps
constexpr int kNewtonRecovery = 300;  // for a start with inverted elements
// Aim below the tolerance: Newton's last iteration is the cheapest, so this costs at most one more.
constexpr double kMargin = 0.03;
constexpr double kStepTolerance = 1e-3;        // for intermediate loads
constexpr double kSmallestShare = 1.0 / 1024;  // fraction of the load
constexpr int kPatienceAtSaddle = 8;           // Newton iterations
constexpr int kNewtonFollowing = 30;           // plain Newton, which converges soon or not at all
constexpr double kFarOff = 0.1;
constexpr double kNearlyThere = 1e-7;  // residual near which another path ends at the same state
constexpr int kMostIterations = 2000;  // conjugate-gradient iterations per Newton iteration

}  // namespace

// Solves for the whole load by Newton's method. If that fails, follows equilibria under growing
// fractions of load and prescribed motion; the increment halves on failure and doubles on success.
// An equilibrium with inverted elements counts as a failure. If no other is found, it is returned
// with `converged` false.
StepReport ImplicitSolver::SolveStatic(BodyState& state, std::span<const glm::dvec3> load,
                                       std::span<const ContactPoint> contacts,
                                       std::span<const glm::dvec3> target, double tolerance,
                                       std::span<ContactResult> results) {
  Impl& body = *impl_;
  StepReport total;
  const std::size_t nodes = body.is_free.size();
  Problem problem{load.empty() ? body.unit_load : load, contacts, target, 1, 1, 0};
  const bool is_state_good = state.x.size() == nodes && AllFinite(state.x);
  if (!is_state_good) state.x = body.good_x;
  state.v.assign(nodes, glm::dvec3(0.0));
  if (!is_state_good || !(tolerance > 0) || !body.Take(problem)) {
    total.is_finite = false;
    return total;
  }
  std::copy(state.x.begin(), state.x.end(), body.begin_x.begin());
  const std::vector<glm::dvec3> start = state.x;
  NewtonGoal goal{.tolerance = tolerance,
                  .max_newton = kNewtonWhole,
                  .max_iterations = std::max(kMostIterations, body.options.max_iterations),
                  .refactors = true};

  std::vector<glm::dvec3> inverted_x;  // an equilibrium with inverted elements, or empty
  StepReport inverted;
  const auto attempt = [&](double share, double from, bool is_last) {
    problem.load_share = share;
    // Fraction of the remaining motion of the fixed axes.
    problem.target_share = from < 1 ? (share - from) / (1 - from) : 1;
    goal.tolerance = kMargin * (is_last ? tolerance : std::max(tolerance, kStepTolerance));
    body.Evaluate(state.x, body.model->material().law, Tangent::kTrue);
    goal.max_newton = goal.follows                 ? kNewtonFollowing
                      : body.assembly.inverted > 0 ? kNewtonRecovery
                                                   : kNewtonWhole;
    const StepReport one = body.Newton(state.x, problem, goal);
    total.newton += one.newton;
    total.iterations += one.iterations;
    total.residual = one.residual;
    total.inverted = one.inverted;
    total.energy = one.energy;
    total.is_finite = one.is_finite;
    total.used_fallback = total.used_fallback || one.used_fallback;
    const bool is_balanced =
        one.is_finite &&
        (one.converged || (one.residual <= goal.tolerance / kMargin && !body.is_recovering));
    // At the whole load, balanced forces do not suffice: a shape with inverted elements is invalid.
    // It is kept in case no other equilibrium is found. At intermediate loads it may be passed.
    total.converged = is_balanced && (one.inverted == 0 || !is_last);
    if (is_balanced && one.inverted > 0 && is_last && inverted_x.empty()) {
      inverted_x = state.x;
      inverted = total;
    }
    return total.converged;
  };
  const auto from_start = [&] {
    state.x = start;
    body.is_recovering = body.has_given_up = false;
    body.projected_left = 0;
  };
  // Follows equilibria under growing fractions of load and prescribed motion.
  const auto climb = [&](double step) {
    from_start();
    double share = 0;
    std::vector<glm::dvec3> good = state.x;
    while (share < 1 && step >= kSmallestShare) {
      const double next = std::min(1.0, share + step);
      if (attempt(next, share, next == 1)) {
        share = next;
        good = state.x;
        step *= 2;
      } else {
        state.x = good;
        body.is_recovering = body.has_given_up = false;
        step /= 2;
      }
    }
    return share == 1;
  };
  goal.patience = kPatienceAtSaddle;
  bool is_done = attempt(1, 0, true);
  if (!is_done && body.met_negative && total.residual > kFarOff) {
    // The first step was too large; the tangent at its end is meaningless.
    goal.patience = kNewtonRecovery;
    is_done = climb(0.25);
  }
  if (!is_done && body.met_negative) {
    // If there are several equilibria, finds the one on the path of the growing load.
    goal.follows = true;
    is_done = climb(1.0);
    goal.follows = false;
    if (!is_done) from_start();
    goal.patience = kNewtonRecovery;
    if (!is_done) is_done = attempt(1, 0, true);
  }
  if (!is_done && (total.inverted > 0 || !(total.residual < kNearlyThere))) {
    const StepReport whole = total;
    const std::vector<glm::dvec3> whole_x = state.x;
    // Keeps the nearer of the two results.
    if (!climb(0.5) && whole.is_finite) {
      state.x = whole_x;
      total = whole;
    }
  }
  if (!total.converged && !inverted_x.empty()) {
    inverted.newton = total.newton;
    inverted.iterations = total.iterations;
    state.x = inverted_x;
    total = inverted;
  }
  problem.load_share = problem.target_share = 1;
  if (!AllFinite(state.x)) {
    state.x = start;
    total.is_finite = false;
    body.is_evaluated = false;
    return total;
  }
  body.Evaluate(state.x, body.model->material().law, Tangent::kTrue);
  body.SetSprings(state.x, false);
  body.FillResults(state.x, results);
  body.FinishReactions(problem);
  body.good_x = state.x;
  std::fill(body.good_v.begin(), body.good_v.end(), glm::dvec3(0.0));
  return total;
}

}  // namespace arthro::simulation

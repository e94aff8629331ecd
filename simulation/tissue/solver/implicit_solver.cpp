#include "simulation/tissue/solver/implicit_solver.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "simulation/core/error.h"
#include "simulation/core/option_fields.h"
#include "simulation/tissue/solver/conjugate_gradients.h"
#include "simulation/tissue/solver/implicit_solver_impl.h"

namespace arthro::simulation {
namespace {

// Fraction of the mean stiffness below which a node belongs to no tissue any more.
constexpr double kNoStiffness = 1e-11;

}  // namespace

ImplicitSolver::Impl::Impl(std::shared_ptr<const FemModel> model_in, FixedAxes fixed_in,
                           const SolverOptions& options_in)
    : model(std::move(model_in)), fixed(std::move(fixed_in)), options(options_in) {
  CheckOptions(options);
  Fit();
  FactorRest();
  MakeRecovery();
  begin_x = good_x = model->mesh().rest_positions;
  good_v.assign(begin_x.size(), glm::dvec3(0.0));
}

void ImplicitSolver::Impl::Fit() {
  const auto nodes = static_cast<std::size_t>(model->node_count());
  if (fixed.empty()) fixed.assign(nodes, 0);
  if (fixed.size() != nodes)
    throw Error(
        Code::kBadArgument,
        fmt::format("there are fixed axes for {} nodes, but the mesh has {}; give one byte a node",
                    fixed.size(), nodes));
  stiffness.pattern = model->pattern();
  stiffness.block.resize(model->pattern()->column.size());
  for (auto* v : {&at, &force, &goal_x, &begin_x, &gradient, &direction, &right, &lead, &trial,
                  &reaction, &unit_load, &tool_right, &tool_left[0], &tool_left[1]})
    v->assign(nodes, glm::dvec3(0.0));
  rotation.assign(nodes, glm::dmat3(1.0));
  added.assign(nodes, 0.0);
  vectors.Resize(model->node_count());
  tool_vectors.Resize(model->node_count());
  is_evaluated = false;

  // Estimates rounding errors; smaller forces and energies count as zero.
  const Material& m = model->material();
  const double lambda = std::abs(LameOf(m).lambda) + LameOf(m).mu + m.fibre_stiffness;
  const double volume = std::max(model->volume(), 1e-30);
  least_force = 1e-12 * m.young_modulus * std::cbrt(volume * volume);
  energy_noise = 1e-15 * lambda * volume;

  // Fixes the nodes of empty elements.
  Evaluate(model->mesh().rest_positions, m.law, Tangent::kTrue);
  force_noise = 10 * Norm(force) + 1e-14 * m.young_modulus * std::cbrt(volume * volume);
  double mean = 0;
  const auto stiffness_of = [&](std::size_t i) {
    const auto& block = stiffness.block[stiffness.pattern->diagonal[i]];
    return block[0] + block[4] + block[8];
  };
  for (std::size_t i = 0; i < nodes; ++i) mean += stiffness_of(i) / static_cast<double>(nodes);
  is_free.resize(nodes);
  for (std::size_t i = 0; i < nodes; ++i) {
    if (!(stiffness_of(i) > kNoStiffness * mean)) fixed[i] = 7;
    is_free[i] = {fixed[i] & 1 ? 0.0 : 1.0, fixed[i] & 2 ? 0.0 : 1.0, fixed[i] & 4 ? 0.0 : 1.0};
  }
}

void ImplicitSolver::Impl::FactorRest() {
  const auto mass = model->mass();
  for (std::size_t i = 0; i < mass.size(); ++i) added[i] = mass[i] / (kUsualStep * kUsualStep);
  auto made = std::make_unique<SparseFactor>(std::make_shared<FactorPlan>(model->pattern(), fixed));
  if (made->Factor(stiffness, added) < 0)
    throw Error(Code::kBadMesh,
                "the stiffness of the mesh at rest cannot be computed with; make the mesh again");
  factor = std::make_unique<RotatedFactor>(std::move(made), rotation);
  age = 0;
}

void ImplicitSolver::Impl::FinishReactions(const Problem& problem) {
  for (std::size_t i = 0; i < reaction.size(); ++i)
    reaction[i] =
        (glm::dvec3(1.0) - is_free[i]) * (-force[i] - problem.load_share * problem.load[i]);
  for (const ContactSpring& spring : springs)
    for (int i = 0; i < spring.contact->count; ++i) {
      const int node = spring.contact->node[i];
      reaction[node] -=
          (glm::dvec3(1.0) - is_free[node]) * spring.contact->weight[i] * spring.force;
    }
}

void ImplicitSolver::Impl::FillResults(std::span<const glm::dvec3> x,
                                       std::span<ContactResult> results) {
  for (std::size_t i = 0; i < std::min(results.size(), springs.size()); ++i)
    results[i] = {ContactPosition(contacts[i], x), springs[i].force, springs[i].gap,
                  springs[i].push};
}

bool ImplicitSolver::Impl::Take(const Problem& problem) {
  const std::size_t nodes = is_free.size();
  if (problem.load.size() != nodes || !AllFinite(problem.load)) return false;
  if (!problem.target.empty() && (problem.target.size() != nodes || !AllFinite(problem.target)))
    return false;
  for (const ContactPoint& contact : problem.contacts)
    if (!IsUsable(contact, model->node_count())) return false;
  contacts.assign(problem.contacts.begin(), problem.contacts.end());
  pressing.assign(contacts.size(), glm::dvec3(0.0));
  springs.resize(contacts.size());
  tool_springs.reserve(contacts.size());
  FindHolds(contacts, holds);
  tool_holds.reserve(holds.size());
  last_dt = problem.dt;
  const auto mass = model->mass();
  for (std::size_t i = 0; i < nodes; ++i)
    added[i] = problem.dt > 0 ? mass[i] / (problem.dt * problem.dt) : 0.0;
  return true;
}

ImplicitSolver::ImplicitSolver(std::shared_ptr<const FemModel> model, FixedAxes fixed,
                               const SolverOptions& options)
    : impl_(std::make_unique<Impl>(std::move(model), std::move(fixed), options)) {}
ImplicitSolver::~ImplicitSolver() = default;
ImplicitSolver::ImplicitSolver(ImplicitSolver&&) noexcept = default;
ImplicitSolver& ImplicitSolver::operator=(ImplicitSolver&&) noexcept = default;

void ImplicitSolver::Reserve(std::size_t contacts) {
  impl_->contacts.reserve(contacts);
  impl_->pressing.reserve(contacts);
  impl_->springs.reserve(contacts);
  impl_->tool_springs.reserve(contacts);
  impl_->holds.reserve(kMostTools);
  impl_->tool_holds.reserve(kMostTools);
}

StepReport ImplicitSolver::Step(BodyState& state, std::span<const glm::dvec3> load,
                                std::span<const ContactPoint> contacts,
                                std::span<const glm::dvec3> target, double dt,
                                std::span<ContactResult> results) noexcept {
  Impl& body = *impl_;
  StepReport report;
  const std::size_t nodes = body.is_free.size();
  const Problem problem{load.empty() ? body.unit_load : load, contacts, target, 1, 1, dt};
  const bool fits = state.x.size() == nodes && state.v.size() == nodes;
  const bool is_state_good = fits && AllFinite(state.x) && AllFinite(state.v);
  if (!is_state_good || !(dt > 0) || !std::isfinite(dt) || !body.Take(problem)) {
    // Refuses invalid input: the state stays, or is reset to the last good one if it was invalid
    // itself.
    if (!is_state_good) {
      state.x.assign(body.good_x.begin(), body.good_x.end());
      state.v.assign(body.good_v.begin(), body.good_v.end());
    }
    report.is_finite = false;
    return report;
  }
  const auto slow_down = [&] {
    bool was_fast = false;
    for (glm::dvec3& v : state.v) {
      const double speed = glm::length(v);
      if (speed <= body.options.max_speed) continue;
      v *= body.options.max_speed / speed;
      was_fast = true;
    }
    return was_fast;
  };
  const bool came_fast = slow_down();
  std::copy(state.x.begin(), state.x.end(), body.begin_x.begin());
  for (std::size_t i = 0; i < nodes; ++i) body.goal_x[i] = state.x[i] + dt * state.v[i];
  std::copy(state.v.begin(), state.v.end(), body.good_v.begin());

  report = body.Newton(state.x, problem,
                       {body.options.tolerance, body.options.max_newton,
                        body.options.max_iterations, body.options.max_work});
  body.last_work = report.work;
  ++body.age;
  ++body.job_age;
  if (!report.is_finite || !AllFinite(state.x)) {
    std::copy(body.begin_x.begin(), body.begin_x.end(), state.x.begin());
    report.is_finite = false;
    body.is_evaluated = false;
    return report;
  }
  body.FillResults(state.x, results);
  body.FinishReactions(problem);
  // A body that was laid anew has no velocity.
  for (std::size_t i = 0; i < nodes; ++i)
    state.v[i] = body.was_refitted ? glm::dvec3(0.0) : (state.x[i] - body.begin_x[i]) / dt;
  report.clamped_speed = slow_down() || came_fast;
  std::copy(state.x.begin(), state.x.end(), body.good_x.begin());
  std::copy(state.v.begin(), state.v.end(), body.good_v.begin());
  return report;
}

std::span<const glm::dvec3> ImplicitSolver::reactions() const { return impl_->reaction; }

}  // namespace arthro::simulation

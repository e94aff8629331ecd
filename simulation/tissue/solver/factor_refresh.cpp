#include <exception>
#include <utility>

#include "simulation/core/error.h"
#include "simulation/tissue/solver/implicit_solver_impl.h"

namespace arthro::simulation {
namespace {

// Time step of the small mass that keeps the factor of a free body, or of a loose node, from being
// singular.
constexpr double kStaticStep = 0.5;  // s

// Largest diagonal shift of a tangent that still makes a preconditioner. On thin remnants of a
// shaved meniscus on bone a system took up to 152 iterations with a shift of 1. It took up to 67
// with a factor of the projected tangent.
constexpr double kMostShift = 1e-3;

}  // namespace

// Adds contact stiffness to its blocks, for a factor that includes contacts. The yielding of tools
// is left to the iterations, because a tool soon moves on.
void ImplicitSolver::Impl::AddSprings(BlockMatrix& to) const {
  for (const ContactSpring& spring : springs) {
    const ContactPoint& contact = *spring.contact;
    if (spring.hold >= 0) continue;
    for (int i = 0; i < contact.count; ++i)
      for (int j = 0; j < contact.count; ++j) {
        const int place = stiffness.pattern->Find(contact.node[i], contact.node[j]);
        if (place < 0) continue;
        for (int a = 0; a < 3; ++a)
          for (int b = 0; b < 3; ++b)
            to.block[place][3 * a + b] +=
                contact.weight[i] * contact.weight[j] * spring.stiffness[b][a];
      }
  }
}

// Factors the last evaluation on this thread. Unless the true tangent is requested, uses the
// projected one if the true one is far from positive definite. Keeps the old factor if memory is
// too small. Returns the number of factorings.
int ImplicitSolver::Impl::FactorNow(std::span<const glm::dvec3> x, bool of_true_tangent) noexcept {
  int factorings = 0;
  try {
    const auto mass = model->mass();
    const double dt = last_dt > 0 ? last_dt : kStaticStep;
    std::vector<double> with(mass.size());
    for (std::size_t i = 0; i < mass.size(); ++i) with[i] = mass[i] / (dt * dt);
    std::shared_ptr<const FactorPlan> plan = std::exchange(next_plan, nullptr);
    if (plan == nullptr || !plan->Fits(*stiffness.pattern, fixed))
      plan = UpdatePlan(factor->factor().shared_plan(), factor->parent(), stiffness.pattern, fixed);
    auto made = std::make_unique<SparseFactor>(std::move(plan));
    made->TakeWorkMemory(factor->factor());
    const auto shift_needed = [&](bool any) {
      BlockMatrix matrix = stiffness;
      AddSprings(matrix);
      const double shift =
          any ? made->Factor(matrix, with) : made->FactorWithin(matrix, with, kMostShift);
      factorings += shift == 0 ? 1 : 2;
      return shift;
    };
    const bool may_project = at_tangent == Tangent::kTrue && !of_true_tangent;
    double shift = shift_needed(!may_project);
    if (shift < 0 && may_project) {
      projected_left = kProjectedIterations;
      Evaluate(x, at_law, Tangent::kProjected);
      shift = shift_needed(true);
    }
    if (shift < 0) return factorings;
    model->NodeRotations(x, rotation);
    factor = std::make_unique<RotatedFactor>(std::move(made), rotation);
    age = 0;
  } catch (const std::exception&) {
  }
  return factorings;
}

void ImplicitSolver::BeginRefresh() {
  Impl& body = *impl_;
  if (body.job == Impl::Job::kBegun) return;  // the factor in preparation comes first
  const Tangent tangent =
      body.met_negative || body.was_shifted ? Tangent::kProjected : Tangent::kTrue;
  if (!body.is_evaluated || body.at_tangent != tangent) {
    const std::vector<glm::dvec3> x = body.good_x;
    body.Evaluate(x, body.model->material().law, tangent);
  }
  body.job_plan = body.factor->factor().shared_plan();
  body.job_plan_parent.assign(body.factor->parent().begin(), body.factor->parent().end());
  body.job_fixed = body.fixed;
  body.job_stiffness = body.stiffness;
  body.AddSprings(body.job_stiffness);
  const auto mass = body.model->mass();
  const double dt = body.last_dt > 0 ? body.last_dt : kStaticStep;
  body.job_added.resize(mass.size());
  for (std::size_t i = 0; i < mass.size(); ++i) body.job_added[i] = mass[i] / (dt * dt);
  body.job_rotation.resize(mass.size());
  body.model->NodeRotations(body.at, body.job_rotation);
  body.job_parent.clear();
  body.job_age = 0;
  body.job = Impl::Job::kBegun;
}

void ImplicitSolver::RunRefresh() noexcept {
  Impl& body = *impl_;
  if (body.job != Impl::Job::kBegun) return;
  try {
    const auto& pattern = body.job_stiffness.pattern;
    const bool fits = body.spare && body.spare->factor().plan().Fits(*pattern, body.job_fixed);
    if (!fits)
      body.spare = std::make_unique<RotatedFactor>(
          std::make_unique<SparseFactor>(
              UpdatePlan(body.job_plan, body.job_plan_parent, pattern, body.job_fixed)),
          body.job_rotation);
    const double shift =
        body.spare->factor().FactorWithin(body.job_stiffness, body.job_added, kMostShift);
    body.spare->SetRotations(body.job_rotation);
    body.job_is_shifted = shift < 0;
    body.job = shift >= 0 ? Impl::Job::kDone : Impl::Job::kFailed;
  } catch (const std::exception&) {  // no memory: the old factor stays
    body.spare.reset();
    body.job = Impl::Job::kFailed;
  }
}

bool ImplicitSolver::TakeRefreshed() noexcept {
  Impl& body = *impl_;
  if (body.job == Impl::Job::kFailed) {
    body.was_shifted = body.job_is_shifted;  // the next one is of the projected tangent
    body.job = Impl::Job::kNone;
  }
  if (body.job != Impl::Job::kDone) return false;
  if (body.job_age > body.age) {  // a step has made a newer one meanwhile
    body.job = Impl::Job::kNone;
    return false;
  }
  body.was_shifted = false;
  std::swap(body.factor, body.spare);
  if (!body.job_parent.empty()) body.factor->Inherit(body.job_parent, body.fixed);
  body.age = body.job_age;
  body.job = Impl::Job::kNone;
  return true;
}

int ImplicitSolver::factor_age() const { return impl_->age; }

void ImplicitSolver::RunPlan() noexcept {
  Impl::PlanJob& job = impl_->plan_job;
  try {
    if (job.before != nullptr)
      job.made = UpdatePlan(job.before, job.parent, job.pattern, job.fixed);
  } catch (const std::exception&) {  // no memory: the step tries it again
  }
}

void ImplicitSolver::TakePlan() noexcept {
  impl_->next_plan = std::exchange(impl_->plan_job, {}).made;
}

void ImplicitSolver::Replace(std::shared_ptr<const FemModel> model, FixedAxes fixed,
                             std::span<const int> parent) {
  Impl& body = *impl_;
  const auto old_nodes = static_cast<int>(body.is_free.size());
  if (static_cast<int>(parent.size()) != model->node_count())
    throw Error(Code::kBadArgument, "a cut body must say of every node which one it was");
  for (const int p : parent)
    if (p < 0 || p >= old_nodes)
      throw Error(
          Code::kBadArgument,
          "a cut body names a node that was not there before; give 0 to the number of nodes");
  std::vector<int> of_job(parent.begin(), parent.end());
  if (!body.job_parent.empty())
    for (int& p : of_job) p = body.job_parent[p];
  std::vector<glm::dvec3> x(parent.size()), v(parent.size());
  for (std::size_t i = 0; i < parent.size(); ++i) {
    x[i] = body.good_x[parent[i]];
    v[i] = body.good_v[parent[i]];
  }
  body.recovery_factor.reset();  // rebuilt when needed
  body.model = std::move(model);
  body.fixed = std::move(fixed);
  body.Fit();
  body.factor->Inherit(parent, body.fixed);
  body.next_plan.reset();
  const std::span<const int> chain = body.factor->parent();
  body.plan_job = {body.factor->factor().shared_plan(),
                   nullptr,
                   {chain.begin(), chain.end()},
                   body.stiffness.pattern,
                   body.fixed};
  body.job_parent = std::move(of_job);
  body.good_x = std::move(x);
  body.good_v = std::move(v);
  body.springs.clear();  // they name old nodes
  body.contacts.clear();
  body.holds.clear();
  body.is_recovering = body.has_given_up = false;
  // The old factor does not know elements that a cut softens a hundredfold. It took up to 200
  // iterations per step, which costs more than a new factor at once.
  body.needs_factor = true;
}

}  // namespace arthro::simulation

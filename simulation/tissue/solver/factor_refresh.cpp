#include <algorithm>

#include "simulation/tissue/solver/implicit_solver_impl.h"

namespace arthro::simulation {
namespace {

// A little mass keeps the factor of a body that nothing holds, or one node, away from singular.
constexpr double kStaticStep = 0.5;  // s

}  // namespace

// Contact stiffness into its blocks, for a factor that knows of it.
void ImplicitSolver::Impl::AddSprings(BlockMatrix& to) const {
  for (const ContactSpring& spring : springs) {
    const ContactPoint& contact = *spring.contact;
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

// On this thread, of the last evaluation.
void ImplicitSolver::Impl::FactorNow(std::span<const glm::dvec3> x) {
  const auto mass = model->mass();
  const double dt = last_dt > 0 ? last_dt : kStaticStep;
  std::vector<double> with(mass.size());
  for (std::size_t i = 0; i < mass.size(); ++i) with[i] = mass[i] / (dt * dt);
  BlockMatrix matrix = stiffness;
  AddSprings(matrix);
  if (!plan || plan->node_count() != model->node_count())
    plan = std::make_shared<FactorPlan>(model->pattern(), fixed);
  auto made = std::make_unique<SparseFactor>(plan);
  if (made->Factor(matrix, with) < 0) return;  // the old one is better than none
  model->NodeRotations(x, rotation);
  factor = std::make_unique<RotatedFactor>(std::move(made), rotation);
  age = 0;
}

}  // namespace arthro::simulation

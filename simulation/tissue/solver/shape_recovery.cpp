#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "simulation/tissue/solver/conjugate_gradients.h"
#include "simulation/tissue/solver/implicit_solver_impl.h"

// Recovery from inverted elements. If more than a fifth of them are inverted, the shape cannot be
// trusted. The body then starts again from its rest shape, fitted to the fixed nodes. Descending
// from there by the law below ended in knots, twisted by whole turns without inverted elements: in
// 1 of 10 random starts on T4, in 5 of 10 on T10.
//
// Otherwise it descends by the corotated law with nu = 0,
//   Ψ = μ ‖F − R‖²,
// whose tangent is bounded by 2μ ∫ ∇N·∇N for every shape. With that fixed matrix each iteration
// lowers the energy without a line search [Bouaziz et al. 2014]: local and global step. The
// tissue's own law takes over afterwards.

namespace arthro::simulation {
namespace {

constexpr int kRounds = 8;            // one solve each; cost of a Newton iteration
constexpr int kLongest = 4000;        // rounds after which inverted elements are accepted
constexpr int kRoundsOnceClean = 16;  // rounds after the last inverted element
constexpr double kSettled = 0.1;      // residual of this law at which recovery ends
constexpr double kTrusted = 0.2;      // fraction of elements that may be inverted

}  // namespace

void ImplicitSolver::Impl::MakeRecovery() {
  Material material = model->material();
  material.law = Law::kCorotated;
  material.poisson_ratio = 0;
  material.fibre_stiffness = 0;
  material.fibre_axis = FibreAxis::kNone;
  recovery_model = std::make_unique<const FemModel>(model->mesh(), material, model->shares());
  recovery_force.assign(is_free.size(), glm::dvec3(0.0));
  // At rest a block is μ(∇a·∇b 1 + ∇b ∇aᵀ), with trace 4μ ∇a·∇b.
  BlockMatrix bound{model->pattern(), std::vector<std::array<double, 9>>(stiffness.block.size())};
  recovery_model->Assemble(model->mesh().rest_positions, Law::kCorotated, Tangent::kTrue,
                           recovery_force, &bound);
  for (auto& block : bound.block) {
    const double value = 0.5 * (block[0] + block[4] + block[8]);
    block = {value, 0, 0, 0, value, 0, 0, 0, value};
  }
  const auto mass = model->mass();
  std::vector<double> with(mass.size());
  for (std::size_t i = 0; i < mass.size(); ++i) with[i] = mass[i] / (kUsualStep * kUsualStep);
  recovery_factor = std::make_unique<SparseFactor>(
      UpdatePlan(factor->factor().shared_plan(), factor->parent(), model->pattern(), fixed));
  recovery_factor->Factor(bound, with);
}

// Moves the rest shape rigidly to the best fit with the fixed nodes, or with all nodes if fewer
// than three are fixed.
void ImplicitSolver::Impl::FitRestShape(std::span<glm::dvec3> x) const {
  const auto& rest = model->mesh().rest_positions;
  const auto mass = model->mass();
  const auto held = std::count(fixed.begin(), fixed.end(), 7);
  const auto weight_of = [&](std::size_t i) {
    return held < 3 ? mass[i] : fixed[i] == 7 ? 1.0 : 0.0;
  };
  double sum = 0;
  glm::dvec3 centre(0.0), rest_centre(0.0);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double w = weight_of(i);
    sum += w;
    centre += w * x[i];
    rest_centre += w * rest[i];
  }
  centre /= sum;
  rest_centre /= sum;
  // Finds the nearest rotation [Kabsch 1978].
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < x.size(); ++i) {
    const glm::dvec3 a = weight_of(i) * (x[i] - centre), b = rest[i] - rest_centre;
    covariance += Eigen::Vector3d(a.x, a.y, a.z) * Eigen::RowVector3d(b.x, b.y, b.z);
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d u = svd.matrixU();
  if ((u * svd.matrixV().transpose()).determinant() < 0) u.col(2) *= -1;
  const Eigen::Matrix3d turn = u * svd.matrixV().transpose();
  for (std::size_t i = 0; i < x.size(); ++i) {
    const glm::dvec3 b = rest[i] - rest_centre;
    const Eigen::Vector3d to = turn * Eigen::Vector3d(b.x, b.y, b.z);
    x[i] += is_free[i] * (centre + glm::dvec3(to.x(), to.y(), to.z()) - x[i]);
  }
}

// Does as many rounds as cost a Newton iteration. Contacts are ignored, because the bound excludes
// their springs.
void ImplicitSolver::Impl::RecoverShape(std::span<glm::dvec3> x, const Problem& problem) {
  if (!is_recovering) {
    recovery_rounds = rounds_once_clean = 0;
    if (assembly.inverted > kTrusted * model->mesh().ElementCount()) {
      FitRestShape(x);
      std::copy(x.begin(), x.end(), goal_x.begin());  // no inertia from the old position
      was_refitted = true;
    }
  }
  is_recovering = true;
  // The bound includes the inertia of a usual step, so for shorter steps the motion is shortened.
  const double inertia = problem.dt > 0 ? kUsualStep / problem.dt : 0.0;
  const double share = 1.0 / std::max(1.0, inertia * inertia);
  for (int round = 0; round < kRounds; ++round, ++recovery_rounds) {
    const Assembly shape =
        recovery_model->Assemble(x, Law::kCorotated, Tangent::kNone, recovery_force, nullptr);
    for (std::size_t i = 0; i < x.size(); ++i) {
      right[i] = recovery_force[i] + problem.load_share * problem.load[i];
      if (problem.dt > 0) right[i] -= added[i] * (x[i] - goal_x[i]);
      right[i] *= is_free[i];
    }
    const double residual = Norm(right) / std::max(Norm(recovery_force), least_force);
    rounds_once_clean = shape.inverted == 0 ? rounds_once_clean + 1 : 0;
    if (shape.inverted == 0 && (residual < kSettled || rounds_once_clean > kRoundsOnceClean))
      is_recovering = false;
    if (recovery_rounds >= kLongest) {
      is_recovering = false;
      has_given_up = true;
    }
    if (!is_recovering) return;
    recovery_factor->Solve(right, direction);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += share * direction[i];
  }
}

}  // namespace arthro::simulation

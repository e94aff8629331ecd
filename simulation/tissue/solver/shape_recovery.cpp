#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "simulation/tissue/solver/implicit_solver_impl.h"
#include "simulation/tissue/solver/node_vectors.h"

// From any start to one without inverted elements. Where more than a fifth of them is inverted,
// nothing of the shape can be trusted: the body begins again from its rest shape, laid on what
// holds it. (Descending from there by the law below ended in knots, twisted by whole turns with no
// element inverted: one of ten random starts on T4, five of ten on T10.) Else by the corotated law
// with nu = 0,
//   Ψ = μ ‖F − R‖²,
// whose tangent is nowhere larger than 2μ ∫ ∇N·∇N, the same for every shape: with that fixed matrix
// each iteration lowers the energy without a line search [Bouaziz et al. 2014]: local and global
// step. The tissue's own law takes over then.

namespace arthro::simulation {
namespace {

constexpr int kRounds = 8;               // a Newton iteration's worth of time; one solve each
constexpr int kLongest = 4000;           // then inverted elements are taken as meant
constexpr int kRoundsOnceClean = 16;     // or
constexpr double kSettled = 0.1;         // residual of this law: it has done its part
constexpr double kTrusted = 0.2;         // of the elements may be inverted
constexpr double kUsualStep = 1.0 / 60;  // s

}  // namespace

void ImplicitSolver::Impl::MakeRecovery() {
  Material material = model->material();
  material.law = Law::kCorotated;
  material.poisson_ratio = 0;
  material.fibre_stiffness = 0;
  material.fibre_axis = FibreAxis::kNone;
  recovery_model = std::make_unique<const FemModel>(model->mesh(), material, model->shares());
  recovery_force.assign(is_free.size(), glm::dvec3(0.0));
  // At rest a block is μ(∇a·∇b 1 + ∇b ∇aᵀ), of trace 4μ ∇a·∇b.
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
      PlanAfter(factor->factor().shared_plan(), factor->parent(), model->pattern(), fixed));
  recovery_factor->Factor(bound, with);
}

// The rest shape, moved rigidly to fit the held nodes best; all nodes where fewer than three are.
void ImplicitSolver::Impl::LayRestShape(std::span<glm::dvec3> x) const {
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
  // The nearest rotation [Kabsch 1978].
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

// A Newton iteration's worth of rounds. Contacts wait meanwhile: their springs are in no bound.
void ImplicitSolver::Impl::RecoverShape(std::span<glm::dvec3> x, const Problem& problem) {
  if (!is_recovering) {
    recovery_rounds = rounds_once_clean = 0;
    if (assembly.inverted > kTrusted * model->mesh().ElementCount()) {
      LayRestShape(x);
      std::copy(x.begin(), x.end(), goal_x.begin());  // no inertia from where it was
      was_laid = true;
    }
  }
  is_recovering = true;
  // The bound was made with the inertia of a usual step: for shorter ones the way is shortened.
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

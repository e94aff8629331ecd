#include "simulation/tissue/solver/conjugate_gradients.h"

#include <algorithm>
#include <cmath>

namespace arthro::simulation {

void LinearSystem::Apply(std::span<const glm::dvec3> p, std::span<glm::dvec3> y) const noexcept {
  Multiply(*stiffness, p, y);
  if (!added.empty())
    for (std::size_t i = 0; i < y.size(); ++i) y[i] += added[i] * p[i];
  AddStiffness(springs, holds, p, y);
  for (std::size_t i = 0; i < y.size(); ++i) y[i] *= is_free[i];
}

namespace {

// Computes r = b − A d and returns the bound for ‖r‖² in the preconditioner's norm. It is relative
// to zᵀr at d = 0, or to a lower bound of the solution's energy, 2 bᵀd − dᵀA d.
double Begin(const LinearSystem& system, std::span<const glm::dvec3> b, const CgGoal& goal,
             CgVectors& vectors, std::span<glm::dvec3> d) noexcept {
  auto& [r, z, p, q] = vectors;
  std::copy(b.begin(), b.end(), r.begin());
  const double relative2 = goal.relative * goal.relative;
  if (goal.starts_at_d) {
    system.Apply(d, q);
    for (std::size_t i = 0; i < r.size(); ++i) r[i] -= q[i];
    const double energy = Dot(b, d) + Dot(r, d);
    if (energy > 0 && std::isfinite(energy)) return relative2 * energy;
    std::copy(b.begin(), b.end(), r.begin());
  }
  std::fill(d.begin(), d.end(), glm::dvec3(0.0));
  return -relative2;
}

}  // namespace

void CgVectors::Resize(int nodes) {
  for (auto* v : {&r, &z, &p, &q}) v->resize(static_cast<std::size_t>(nodes));
}

CgResult SolveByGradients(const LinearSystem& system, RotatedFactor& preconditioner,
                          std::span<const glm::dvec3> b, const CgGoal& goal, CgVectors& vectors,
                          std::span<glm::dvec3> d) noexcept {
  auto& [r, z, p, q] = vectors;
  CgResult result;
  double enough = Begin(system, b, goal, vectors, d);
  preconditioner.Solve(r, z);
  double rz = Dot(r, z);
  if (enough < 0) enough *= -rz;
  if (!(rz > 0) ||
      (goal.starts_at_d && rz <= enough && (goal.residual == 0 || Norm(r) <= goal.residual))) {
    result.converged = rz >= 0;
    return result;
  }
  std::copy(z.begin(), z.end(), p.begin());
  while (result.iterations < goal.max_iterations) {
    system.Apply(p, q);
    const double curvature = Dot(p, q);
    if (!(curvature > 0)) {
      result.is_positive = false;
      if (!goal.takes_saddles || !(curvature < 0)) return result;
    }
    ++result.iterations;
    const double step = rz / curvature;
    for (std::size_t i = 0; i < r.size(); ++i) {
      d[i] += step * p[i];
      r[i] -= step * q[i];
    }
    preconditioner.Solve(r, z);
    const double next = Dot(r, z);
    if (!std::isfinite(next)) return result;
    if (next <= enough && (goal.residual == 0 || Norm(r) <= goal.residual)) {
      result.converged = true;
      return result;
    }
    const double turn = next / rz;
    rz = next;
    for (std::size_t i = 0; i < p.size(); ++i) p[i] = z[i] + turn * p[i];
  }
  return result;
}

}  // namespace arthro::simulation

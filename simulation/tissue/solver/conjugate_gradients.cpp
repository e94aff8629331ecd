#include "simulation/tissue/solver/conjugate_gradients.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "simulation/tissue/solver/node_vectors.h"

namespace arthro::simulation {

void LinearSystem::Apply(std::span<const glm::dvec3> p, std::span<glm::dvec3> y) const noexcept {
  Multiply(*stiffness, p, y);
  if (!added.empty())
    for (std::size_t i = 0; i < y.size(); ++i) y[i] += added[i] * p[i];
  AddStiffness(springs, holds, p, y);
  for (std::size_t i = 0; i < y.size(); ++i) y[i] *= is_free[i];
}

void CgVectors::Resize(int nodes) {
  for (auto* v : {&r, &z, &p, &q}) v->resize(static_cast<std::size_t>(nodes));
}

CgResult SolveByGradients(const LinearSystem& system, RotatedFactor& preconditioner,
                          std::span<const glm::dvec3> b, const CgGoal& goal, CgVectors& vectors,
                          std::span<glm::dvec3> d) noexcept {
  auto& [r, z, p, q] = vectors;
  CgResult result;
  std::copy(b.begin(), b.end(), r.begin());
  std::fill(d.begin(), d.end(), glm::dvec3(0.0));
  preconditioner.Solve(r, z);
  double rz = Dot(r, z);
  const double enough = goal.relative * goal.relative * rz;
  if (!(rz > 0)) {
    result.converged = rz == 0;
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

CgResult SolveThree(const LinearSystem& system, RotatedFactor& preconditioner,
                    std::span<const std::vector<glm::dvec3>, 3> b, const CgGoal& goal,
                    std::span<CgVectors, 3> vectors,
                    std::span<std::vector<glm::dvec3>, 3> d) noexcept {
  CgResult result;
  std::array<std::span<const glm::dvec3>, 3> r;
  std::array<std::span<glm::dvec3>, 3> z;
  std::array<double, 3> rz{}, enough{};
  std::array<bool, 3> is_done{};
  for (int c = 0; c < 3; ++c) {
    std::copy(b[c].begin(), b[c].end(), vectors[c].r.begin());
    std::fill(d[c].begin(), d[c].end(), glm::dvec3(0.0));
    r[c] = vectors[c].r;
    z[c] = vectors[c].z;
  }
  preconditioner.Solve(r, z);
  for (int c = 0; c < 3; ++c) {
    rz[c] = Dot(r[c], z[c]);
    enough[c] = goal.relative * goal.relative * rz[c];
    is_done[c] = !(rz[c] > 0);
    std::copy(z[c].begin(), z[c].end(), vectors[c].p.begin());
  }
  while (!(is_done[0] && is_done[1] && is_done[2]) && result.iterations < goal.max_iterations) {
    ++result.iterations;
    for (int c = 0; c < 3; ++c) {
      if (is_done[c]) continue;
      auto& v = vectors[c];
      system.Apply(v.p, v.q);
      const double curvature = Dot(v.p, v.q);
      if (!(curvature > 0)) {
        result.is_positive = false;
        is_done[c] = true;
        continue;
      }
      const double step = rz[c] / curvature;
      for (std::size_t i = 0; i < v.r.size(); ++i) {
        d[c][i] += step * v.p[i];
        v.r[i] -= step * v.q[i];
      }
    }
    preconditioner.Solve(r, z);
    for (int c = 0; c < 3; ++c) {
      if (is_done[c]) continue;
      auto& v = vectors[c];
      const double next = Dot(v.r, v.z);
      is_done[c] = !std::isfinite(next) || next <= enough[c];
      const double turn = next / rz[c];
      rz[c] = next;
      for (std::size_t i = 0; i < v.p.size(); ++i) v.p[i] = v.z[i] + turn * v.p[i];
    }
  }
  result.converged = is_done[0] && is_done[1] && is_done[2] && result.is_positive;
  return result;
}

}  // namespace arthro::simulation

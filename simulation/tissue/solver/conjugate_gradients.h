// Preconditioned conjugate gradients for a body's linear system (K + M/dt² + Σ JᵀkJ) d = b over its
// free axes. Sums have a fixed order; nothing is allocated.
#pragma once

#include <array>
#include <cmath>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "simulation/core/finite.h"
#include "simulation/tissue/factor/rotated_factor.h"
#include "simulation/tissue/fem/block_matrix.h"
#include "simulation/tissue/solver/contact_springs.h"

namespace arthro::simulation {

// Sums over vectors with three numbers per node, in an order that does not depend on the processor:
// eight partial sums, added in a fixed tree at the end.
inline double Dot(std::span<const glm::dvec3> a, std::span<const glm::dvec3> b) noexcept {
  if (a.empty()) return 0;
  const double *p = &a[0].x, *q = &b[0].x;
  const std::size_t n = 3 * a.size();
  std::array<double, 8> sum{};
  std::size_t i = 0;
  for (; i + 8 <= n; i += 8)
    for (std::size_t l = 0; l < 8; ++l) sum[l] += p[i + l] * q[i + l];
  for (std::size_t l = 0; i < n; ++i, ++l) sum[l] += p[i] * q[i];
  return ((sum[0] + sum[4]) + (sum[1] + sum[5])) + ((sum[2] + sum[6]) + (sum[3] + sum[7]));
}

inline double Norm(std::span<const glm::dvec3> a) noexcept { return std::sqrt(Dot(a, a)); }

struct LinearSystem {
  const BlockMatrix* stiffness = nullptr;
  std::span<const double> added;  // M/dt², N/m per node
  std::span<const ContactSpring> springs;
  std::span<const ToolHold> holds;
  std::span<const glm::dvec3> is_free;  // 1 or 0 per axis

  // Computes y = A p, 0 at fixed axes; p may be non-zero there.
  void Apply(std::span<const glm::dvec3> p, std::span<glm::dvec3> y) const noexcept;
};

struct CgGoal {
  double relative = 1e-2;  // goal for the error's energy norm, as seen by the preconditioner
  double residual = 0;     // unless 0, ‖b − A d‖ must also be below this, N
  int max_iterations = 200;
  bool starts_at_d =
      false;  // instead of at 0; `relative` then refers to the solution's energy norm
  // Continues at negative stiffness, to a saddle point if the system has one.
  bool takes_saddles = false;
};

struct CgResult {
  int iterations = 0;
  bool converged = false;
  bool is_positive = true;  // false: met a direction of stiffness ≤ 0; d is unfinished
};

struct CgVectors {
  std::vector<glm::dvec3> r, z, p, q;
  void Resize(int nodes);
};

// b, and an initial d, must be 0 at fixed axes. Leaves b − A d in vectors.r.
CgResult SolveByGradients(const LinearSystem& system, RotatedFactor& preconditioner,
                          std::span<const glm::dvec3> b, const CgGoal& goal, CgVectors& vectors,
                          std::span<glm::dvec3> d) noexcept;

}  // namespace arthro::simulation

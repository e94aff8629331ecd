// Sums over vectors with three numbers a node, in an order that does not depend on the processor:
// eight running sums, added in a fixed tree at the end.
#pragma once

#include <array>
#include <cmath>
#include <span>

#include <glm/vec3.hpp>

#include "simulation/core/finite.h"

namespace arthro::simulation {

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

}  // namespace arthro::simulation

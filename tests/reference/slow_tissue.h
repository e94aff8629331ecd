// Forces of a deformed tissue straight from the formula of its energy, by an independent and slow
// method: the energy of each element is summed in extended precision over its quadrature points,
// and every node is moved a little along each axis. Needs no stored values and shares no code with
// simulation/tissue but the types. SI, the mesh's own frame.
#pragma once

#include <array>
#include <cmath>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include "simulation/scene/mesh/tet_mesh.h"
#include "simulation/tissue/fem/material.h"

namespace arthro::test {

using Real = long double;
using RealVector = glm::vec<3, Real, glm::highp>;
using RealMatrix = glm::mat<3, 3, Real, glm::highp>;

// Rotation of the polar decomposition by Newton's iteration R ← (R + R⁻ᵀ)/2 [Higham 1986].
inline RealMatrix PolarRotation(RealMatrix r) {
  for (int i = 0; i < 20; ++i) r = Real(0.5) * (r + glm::transpose(glm::inverse(r)));
  return r;
}

inline Real Squared(const RealMatrix& m) {
  Real sum = 0;
  for (int k = 0; k < 3; ++k) sum += glm::dot(m[k], m[k]);
  return sum;
}

// Energy density Ψ(F), J/m³, up to a constant. `fibre` is the unit direction at rest.
inline Real EnergyDensity(const simulation::Material& material, const RealMatrix& f,
                          const RealVector& fibre) {
  const Real e = material.young_modulus, nu = material.poisson_ratio;
  const Real mu = e / (2 * (1 + nu)), lambda = e * nu / ((1 + nu) * (1 - 2 * nu));
  Real energy = 0;
  if (material.law == simulation::Law::kCorotated) {
    const RealMatrix r = PolarRotation(f), stretch = glm::transpose(r) * f;
    const Real trace = stretch[0][0] + stretch[1][1] + stretch[2][2] - 3;
    energy = mu * Squared(f - r) + lambda / 2 * trace * trace;
  } else {
    const Real from_rest = glm::determinant(f) - (1 + mu / (lambda + mu));
    energy = mu / 2 * (Squared(f) - 3) + (lambda + mu) / 2 * from_rest * from_rest;
  }
  if (material.fibre_axis == simulation::FibreAxis::kCircumferentialZ) {
    const Real stretch = glm::length(f * fibre) - 1;
    energy += Real(material.fibre_stiffness) / 2 * stretch * stretch;
  }
  return energy;
}

// Energy of one element whose nodes are at `x`: elastic, and of a constant body force, N/m³.
inline Real ElementEnergy(const simulation::Material& material, std::span<const RealVector> rest,
                          std::span<const RealVector> x, const RealVector& body_force) {
  const bool is_quadratic = x.size() == 10;
  constexpr std::array<std::array<int, 2>, 6> kEdges = {
      {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};
  // Gradients of the barycentric coordinates in the unit tetrahedron.
  constexpr std::array<std::array<Real, 3>, 4> kSlope = {
      {{-1, -1, -1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  const Real near = (5 - std::sqrt(Real(5))) / 20, far = 1 - 3 * near;  // four points, degree 2
  Real energy = 0;
  for (int point = 0; point < (is_quadratic ? 4 : 1); ++point) {
    std::array<Real, 4> l;
    l.fill(is_quadratic ? near : Real(0.25));
    if (is_quadratic) l[static_cast<std::size_t>(point)] = far;
    std::array<Real, 10> shape{};
    std::array<RealVector, 10> slope{};
    const auto slope_of = [&](std::size_t i) {
      return RealVector(kSlope[i][0], kSlope[i][1], kSlope[i][2]);
    };
    for (std::size_t i = 0; i < 4; ++i) {
      shape[i] = is_quadratic ? l[i] * (2 * l[i] - 1) : l[i];
      slope[i] = (is_quadratic ? 4 * l[i] - 1 : Real(1)) * slope_of(i);
    }
    for (std::size_t k = 0; is_quadratic && k < 6; ++k) {
      const auto a = static_cast<std::size_t>(kEdges[k][0]),
                 b = static_cast<std::size_t>(kEdges[k][1]);
      shape[4 + k] = 4 * l[a] * l[b];
      slope[4 + k] = Real(4) * (l[a] * slope_of(b) + l[b] * slope_of(a));
    }
    RealMatrix rest_jacobian(Real(0)), jacobian(Real(0));
    RealVector rest_place(Real(0)), place(Real(0));
    for (std::size_t i = 0; i < x.size(); ++i) {
      rest_jacobian += glm::outerProduct(rest[i], slope[i]);
      jacobian += glm::outerProduct(x[i], slope[i]);
      rest_place += shape[i] * rest[i];
      place += shape[i] * x[i];
    }
    const RealMatrix f = jacobian * glm::inverse(rest_jacobian);
    const Real radius = std::hypot(rest_place.x, rest_place.y);
    const RealVector fibre =
        radius > 0 ? RealVector(-rest_place.y, rest_place.x, 0) / radius : RealVector(0, 1, 0);
    const Real volume = glm::determinant(rest_jacobian) / (is_quadratic ? 24 : 6);
    energy += volume * (EnergyDensity(material, f, fibre) - glm::dot(body_force, place));
  }
  return energy;
}

// Force on each node, N: minus the derivative of the energy, by five-point differences.
inline std::vector<glm::dvec3> SlowForces(const TetMesh& mesh, const simulation::Material& material,
                                          std::span<const glm::dvec3> x,
                                          const glm::dvec3& body_force) {
  const auto nodes = static_cast<std::size_t>(mesh.NodesPerElement());
  std::vector<RealVector> force(x.size(), RealVector(Real(0)));
  std::vector<RealVector> rest(nodes), at(nodes);
  for (std::size_t e = 0; e < mesh.elements.size(); e += nodes) {
    for (std::size_t i = 0; i < nodes; ++i) {
      const auto node = static_cast<std::size_t>(mesh.elements[e + i]);
      rest[i] = RealVector(mesh.rest_positions[node]);
      at[i] = RealVector(x[node]);
    }
    const Real step = Real(1e-4) * glm::length(rest[1] - rest[0]);
    for (std::size_t i = 0; i < nodes; ++i)
      for (int axis = 0; axis < 3; ++axis) {
        const Real here = at[i][axis];
        const auto energy = [&](int steps) {
          at[i][axis] = here + steps * step;
          const Real value = ElementEnergy(material, rest, at, RealVector(body_force));
          at[i][axis] = here;
          return value;
        };
        force[static_cast<std::size_t>(mesh.elements[e + i])][axis] -=
            (8 * (energy(1) - energy(-1)) - (energy(2) - energy(-2))) / (12 * step);
      }
  }
  std::vector<glm::dvec3> rounded;
  for (const RealVector& f : force) rounded.emplace_back(f);
  return rounded;
}

}  // namespace arthro::test

// Preconditioner: a Cholesky factor of an earlier state of the body, rotated node by node to the
// present state: P⁻¹ = Q A₀⁻¹ Qᵀ, with Q the rotation of each node's neighbourhood since then
// [method.md, Deformable tissue]. With `parent` it also serves a body that has been cut since.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "simulation/tissue/factor/sparse_factor.h"

namespace arthro::simulation {

class RotatedFactor {
 public:
  // `rotation`: node rotations when the matrix was assembled.
  RotatedFactor(std::unique_ptr<SparseFactor> factor, std::span<const glm::dmat3> rotation);

  SparseFactor& factor() { return *factor_; }
  // Returns the factor's node of each node of the body; empty: the same nodes.
  std::span<const int> parent() const { return parent_; }
  // Call after factoring again into the same memory: the factor belongs to its own plan's body
  // again.
  void SetRotations(std::span<const glm::dmat3> rotation);

  // Declares that node i of the body is a copy of the former node parent[i]; `fixed` holds its
  // fixed axes.
  void Inherit(std::span<const int> parent, const FixedAxes& fixed);

  // Sets the present rotations of the body's nodes.
  void SetCurrentRotations(std::span<const glm::dmat3> rotation) noexcept;
  // Sets the present block diagonal of the body; has an effect only at split nodes.
  void SetDiagonal(const BlockMatrix& a, std::span<const double> added) noexcept;

  // Computes z = P⁻¹ r, 0 at fixed axes. Allocates nothing.
  void Solve(std::span<const glm::dvec3> r, std::span<glm::dvec3> z) noexcept;

 private:
  std::unique_ptr<SparseFactor> factor_;
  FixedAxes fixed_;                      // fixed axes of the body
  std::vector<glm::dmat3> then_, turn_;  // per node of the body: rotation when factored, Q
  std::vector<int> parent_;              // empty: the body has not been cut
  std::vector<glm::dmat3> block_;        // at split nodes: inverse of the diagonal block, else 0
  std::vector<unsigned char> is_split_;
  std::vector<glm::dvec3> right_, left_;  // per node of the factor
};

}  // namespace arthro::simulation

// The preconditioner: a Cholesky factor of the body as it was some time ago, turned node by node to
// where the body is now: P⁻¹ = Q A₀⁻¹ Qᵀ with Q the rotation of each node's neighbourhood since
// then [method.md, Deformable tissue]. Through
// `parent` it serves a body that has been cut since.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "simulation/tissue/factor/sparse_factor.h"

namespace arthro::simulation {

class RotatedFactor {
 public:
  // `rotation`: of the nodes when the matrix was taken.
  RotatedFactor(std::unique_ptr<SparseFactor> factor, std::span<const glm::dmat3> rotation);

  SparseFactor& factor() { return *factor_; }
  // A node of the body: which one it is in the factor; empty: the same.
  std::span<const int> parent() const { return parent_; }
  // After factoring anew into the same memory: a factor of its own plan's body again.
  void SetRotations(std::span<const glm::dmat3> rotation);

  // Node i of the body is now what node parent[i] was before; `fixed` are its fixed axes.
  void Inherit(std::span<const int> parent, const FixedAxes& fixed);

  // The rotations of the body's nodes now.
  void TurnTo(std::span<const glm::dmat3> rotation) noexcept;
  // The body's block diagonal now; needed where nodes have split, does nothing where none have.
  void SetDiagonal(const BlockMatrix& a, std::span<const double> added) noexcept;

  // z = P⁻¹ r; 0 at fixed axes. Allocates nothing.
  void Solve(std::span<const glm::dvec3> r, std::span<glm::dvec3> z) noexcept {
    Solve(std::span(&r, 1), std::span(&z, 1));
  }
  // The same for 1 or 3 vectors at once.
  void Solve(std::span<const std::span<const glm::dvec3>> r,
             std::span<const std::span<glm::dvec3>> z) noexcept;

 private:
  std::unique_ptr<SparseFactor> factor_;
  FixedAxes fixed_;                      // of the body
  std::vector<glm::dmat3> then_, turn_;  // a node of the body: rotation when factored, Q
  std::vector<int> parent_;              // empty: the body is as it was
  std::vector<glm::dmat3> block_;        // where split: inverse of the diagonal block, else 0
  std::vector<unsigned char> is_split_;
  std::array<std::vector<glm::dvec3>, 3> right_, left_;  // nodes of the factor
};

}  // namespace arthro::simulation

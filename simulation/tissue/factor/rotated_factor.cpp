#include "simulation/tissue/factor/rotated_factor.h"

#include <algorithm>
#include <cmath>

#include <glm/matrix.hpp>

namespace arthro::simulation {
namespace {

glm::dvec3 FreePart(const glm::dvec3& v, std::uint8_t fixed) {
  return {fixed & 1 ? 0.0 : v.x, fixed & 2 ? 0.0 : v.y, fixed & 4 ? 0.0 : v.z};
}

}  // namespace

RotatedFactor::RotatedFactor(std::unique_ptr<SparseFactor> factor,
                             std::span<const glm::dmat3> rotation)
    : factor_(std::move(factor)) {
  const std::size_t nodes = factor_->plan().fixed().size();
  right_.resize(nodes);
  left_.resize(nodes);
  SetRotations(rotation);
}

void RotatedFactor::SetRotations(std::span<const glm::dmat3> rotation) {
  fixed_ = factor_->plan().fixed();
  then_.assign(rotation.begin(), rotation.end());
  turn_.assign(rotation.size(), glm::dmat3(1.0));
  parent_.clear();
  block_.clear();
  is_split_.clear();
}

void RotatedFactor::Inherit(std::span<const int> parent, const FixedAxes& fixed) {
  const std::size_t nodes = parent.size();
  std::vector<int> chain(parent.begin(), parent.end());
  std::vector<glm::dmat3> then(nodes);
  for (std::size_t i = 0; i < nodes; ++i) {
    then[i] = then_[parent[i]];
    if (!parent_.empty()) chain[i] = parent_[parent[i]];
  }
  std::vector<int> children(right_.size(), 0);
  for (const int p : chain) ++children[p];
  is_split_.resize(nodes);
  for (std::size_t i = 0; i < nodes; ++i) is_split_[i] = children[chain[i]] > 1;
  parent_ = std::move(chain);
  then_ = std::move(then);
  turn_.assign(nodes, glm::dmat3(1.0));
  block_.assign(nodes, glm::dmat3(0.0));
  fixed_ = fixed;
}

void RotatedFactor::SetCurrentRotations(std::span<const glm::dmat3> rotation) noexcept {
  for (std::size_t i = 0; i < turn_.size(); ++i)
    turn_[i] = fixed_[i] ? glm::dmat3(1.0) : rotation[i] * glm::transpose(then_[i]);
}

void RotatedFactor::SetDiagonal(const BlockMatrix& a, std::span<const double> added) noexcept {
  for (std::size_t i = 0; i < block_.size(); ++i) {
    if (!is_split_[i]) continue;
    const auto& b = a.block[a.pattern->diagonal[i]];
    glm::dmat3 m(b[0], b[3], b[6], b[1], b[4], b[7], b[2], b[5], b[8]);
    const double most = std::abs(m[0][0]) + std::abs(m[1][1]) + std::abs(m[2][2]);
    for (int k = 0; k < 3; ++k) m[k][k] += added[i] + 1e-3 * most;
    const glm::dmat3 inverse = glm::inverse(m);
    // A block that is not positive definite is replaced by its trace.
    const bool is_good = m[0][0] > 0 && m[0][0] * m[1][1] > m[0][1] * m[0][1] &&
                         glm::determinant(m) > 0 && std::isfinite(inverse[0][0]);
    block_[i] = is_good ? 0.5 * (inverse + glm::transpose(inverse))
                        : glm::dmat3(most > 0 ? 1.0 / (most + added[i]) : 0.0);
  }
}

void RotatedFactor::Solve(std::span<const glm::dvec3> r, std::span<glm::dvec3> z) noexcept {
  const std::size_t nodes = turn_.size();
  if (parent_.empty()) {
    for (std::size_t i = 0; i < nodes; ++i) right_[i] = r[i] * turn_[i];  // Qᵀ r
    factor_->Solve(right_, left_);
    for (std::size_t i = 0; i < nodes; ++i) z[i] = turn_[i] * left_[i];
    return;
  }
  std::fill(right_.begin(), right_.end(), glm::dvec3(0.0));
  for (std::size_t i = 0; i < nodes; ++i) right_[parent_[i]] += r[i] * turn_[i];
  factor_->Solve(right_, left_);
  // The old factor moves split nodes together; their own blocks move them apart.
  for (std::size_t i = 0; i < nodes; ++i) {
    glm::dvec3 zi = turn_[i] * left_[parent_[i]];
    if (is_split_[i]) zi += block_[i] * r[i];
    z[i] = FreePart(zi, fixed_[i]);
  }
}

}  // namespace arthro::simulation

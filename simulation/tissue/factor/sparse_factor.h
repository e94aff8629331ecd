// Cholesky factor of a sparse symmetric positive definite matrix of 3×3 blocks, over its free axes.
// CHOLMOD orders the nodes and finds the supernodes, once. The numeric part is our own: supernodal,
// left-looking, with the same bits whatever BLAS is installed.
//
// It factors in double and stores floats as panels [L₁₁⁻¹; L₂₁ L₁₁⁻¹], so that a solve is one
// streaming product per panel each way. Floats halve the memory traffic that limits a solve. The
// accuracy of about 1e-6 suffices for a preconditioner: panels in double saved no iteration, even
// at nu = 0.4999. Solve allocates nothing.
//
// Processor time at 5,900 axes, -O2:
//   this factor           29 ms to factor,  0.44 ms to solve
//   CHOLMOD, ATLAS        54 ms             1.1 ms
//   CHOLMOD, Debian BLAS  103 ms            1.6 ms
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "simulation/tissue/fem/block_matrix.h"

namespace arthro::simulation {

// Supernodes of a pattern without its fixed axes. Immutable; shared by factors.
class FactorPlan {
 public:
  // `fixed` has one byte per node, or is empty. Throws Error(kBadMesh) if memory is too small.
  FactorPlan(std::shared_ptr<const BlockPattern> pattern, FixedAxes fixed);
  // Plans for a body that was cut from the body of `before`, in which node i was node parent[i].
  // Node i takes that node's place in the order. Copies of a node have no additional neighbours, so
  // the order usually stays good; otherwise a new one is computed. This takes a third of the time.
  FactorPlan(std::shared_ptr<const BlockPattern> pattern, FixedAxes fixed, const FactorPlan& before,
             std::span<const int> parent);
  // Returns whether the plan fits a matrix of this pattern.
  bool Fits(const BlockPattern& pattern, const FixedAxes& fixed) const {
    return (pattern_.get() == &pattern || *pattern_ == pattern) && fixed_ == fixed;
  }

  int node_count() const { return pattern_->node_count(); }
  int size() const { return size_; }                   // free axes
  double flops() const { return flops_; }              // per factorisation
  std::int64_t stored() const { return panel_size_; }  // numbers in the panels, including padding
  const std::shared_ptr<const BlockPattern>& pattern() const { return pattern_; }
  const FixedAxes& fixed() const { return fixed_; }

 private:
  friend class SparseFactor;
  struct Supernode {
    int first, columns, rows;  // in the permuted matrix; its own rows come first
    int stride;                // RoundUpToStrip(rows)
    std::int64_t row, value;   // start of its rows and of its panel
  };
  struct Entry {
    std::int64_t to;    // position in the panels
    std::int32_t from;  // block · 9 + entry
  };
  // `order` of the nodes; if empty, an order is computed.
  void Analyse(std::vector<int> order);

  std::shared_ptr<const BlockPattern> pattern_;
  FixedAxes fixed_;
  std::vector<int> rank_;    // per node: its position in the order
  double sought_flops_ = 0;  // flops per free axis when the order was computed
  int size_ = 0, widest_ = 0, tallest_ = 0;
  std::int64_t panel_size_ = 0;
  double flops_ = 0;
  std::vector<int> axis_;  // permuted index -> node · 3 + axis
  std::vector<Supernode> supernode_;
  std::vector<int> row_;    // permuted indices
  std::vector<int> owner_;  // permuted index -> supernode
  std::vector<Entry> entry_;
};

// Returns a plan for a body that was cut since `before`, or `before` itself if it still fits. An
// empty `parent` means the same nodes with other fixed axes.
std::shared_ptr<const FactorPlan> UpdatePlan(const std::shared_ptr<const FactorPlan>& before,
                                             std::span<const int> parent,
                                             const std::shared_ptr<const BlockPattern>& pattern,
                                             const FixedAxes& fixed);

class SparseFactor {
 public:
  explicit SparseFactor(std::shared_ptr<const FactorPlan> plan);

  // Factors a + diag(added) (N/m per node, may be empty). If the matrix is not positive definite,
  // adds a growing fraction of its own diagonal. Returns that fraction (0: none needed), or −1 for
  // values that are not finite. May allocate the first time.
  double Factor(const BlockMatrix& a, std::span<const double> added);
  // The same with no fraction or with this one only: −1 where both are too little. Ends sooner for
  // a matrix that is far from positive definite.
  double FactorWithin(const BlockMatrix& a, std::span<const double> added, double shift);

  // Takes over the work memory of another factor, because getting pages from the system costs a
  // tenth of the time. Not to be called while either one factors.
  void TakeWorkMemory(SparseFactor& other) noexcept;

  // Computes x = A⁻¹ b, 0 at fixed axes. Not thread-safe: it uses its own buffer.
  void Solve(std::span<const glm::dvec3> b, std::span<glm::dvec3> x) noexcept;

  const FactorPlan& plan() const { return *plan_; }
  const std::shared_ptr<const FactorPlan>& shared_plan() const { return plan_; }

 private:
  void TakeRoom();
  bool TryFactor(const BlockMatrix& a, std::span<const double> added, double shift);

  std::shared_ptr<const FactorPlan> plan_;
  std::vector<double> work_;  // panels of L during factoring
  std::vector<double> inverse_, product_, right_;
  std::vector<int> map_, head_, next_, position_;
  std::vector<float> storage_;
  float* panels_ = nullptr;  // 64-byte aligned
  std::vector<float> vector_, strip_, short_;
};

}  // namespace arthro::simulation

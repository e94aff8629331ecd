// Cholesky factor of a sparse symmetric positive definite matrix of 3×3 blocks, over the axes that
// are free. CHOLMOD orders the nodes and finds the supernodes, once; the numbers are our own:
// supernodal, left-looking, with the same bits whatever BLAS is installed. Factored in double, kept
// in float as panels [L₁₁⁻¹; L₂₁ L₁₁⁻¹], so that a solve is one streaming product a panel each way:
// half the memory traffic of double, which is what bounds it; good to about 1e-6, as a
// preconditioner wants (panels in double saved no iteration, at nu = 0.4999 neither). At 5.9
// thousand axes 29 ms to factor and 0.44 ms to solve, where CHOLMOD takes 54 and 1.1 with ATLAS,
// 103 and 1.6 with Debian's reference BLAS (processor time on the project's machine, -O2). Solve
// allocates nothing.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "simulation/tissue/factor/fixed_axes.h"
#include "simulation/tissue/fem/block_matrix.h"

namespace arthro::simulation {

// The supernodes of a pattern with its fixed axes left out. Immutable; shared by factors.
class FactorPlan {
 public:
  // `fixed`: one byte a node, or empty. Throws Error(kBadMesh) where memory does not do.
  FactorPlan(std::shared_ptr<const BlockPattern> pattern, FixedAxes fixed);
  // Of a body that was cut out of the one of `before`: node i was node parent[i] there, and goes in
  // its place in the order. Copies of a node meet no more than it did, so the order stays as good;
  // where it does not, it is made anew. A third of the time.
  FactorPlan(std::shared_ptr<const BlockPattern> pattern, FixedAxes fixed, const FactorPlan& before,
             std::span<const int> parent);
  // Does it serve a matrix of this pattern?
  bool Fits(const BlockPattern& pattern, const FixedAxes& fixed) const {
    return (pattern_.get() == &pattern || *pattern_ == pattern) && fixed_ == fixed;
  }

  int node_count() const { return pattern_->node_count(); }
  int size() const { return size_; }                   // free axes
  double flops() const { return flops_; }              // of one factorisation
  std::int64_t stored() const { return panel_size_; }  // numbers in the panels, padding included
  const std::shared_ptr<const BlockPattern>& pattern() const { return pattern_; }
  const FixedAxes& fixed() const { return fixed_; }

 private:
  friend class SparseFactor;
  struct Supernode {
    int first, columns, rows;  // of the permuted matrix; its own rows come first
    int stride;                // StripsOf(rows)
    std::int64_t row, value;   // where its rows and its panel begin
  };
  struct Entry {
    std::int64_t to;    // in the panels
    std::int32_t from;  // block · 9 + entry
  };
  // `order`: of the nodes, or empty: one is sought.
  void Analyse(std::vector<int> order);

  std::shared_ptr<const BlockPattern> pattern_;
  FixedAxes fixed_;
  std::vector<int> rank_;    // a node: its place in the order
  double sought_flops_ = 0;  // when an order was sought last, a free axis
  int size_ = 0, widest_ = 0, tallest_ = 0;
  std::int64_t panel_size_ = 0;
  double flops_ = 0;
  std::vector<int> axis_;  // permuted index -> node · 3 + axis
  std::vector<Supernode> supernode_;
  std::vector<int> row_;    // permuted indices
  std::vector<int> owner_;  // permuted index -> supernode
  std::vector<Entry> entry_;
};

// The plan for a body that was cut since `before`; the same where it still fits. `parent` as above;
// empty: the same nodes, of which others are held.
std::shared_ptr<const FactorPlan> PlanAfter(const std::shared_ptr<const FactorPlan>& before,
                                            std::span<const int> parent,
                                            const std::shared_ptr<const BlockPattern>& pattern,
                                            const FixedAxes& fixed);

class SparseFactor {
 public:
  explicit SparseFactor(std::shared_ptr<const FactorPlan> plan);

  // Factors a + diag(added) (N/m a node, may be empty) and, should that not be positive, the same
  // with a growing part of its own diagonal added. Returns how large that part was (0: none
  // needed); −1: not finite. May allocate the first time.
  double Factor(const BlockMatrix& a, std::span<const double> added);

  // What another one works in while it factors, since the system's pages for it take a tenth of the
  // time. Not while either does.
  void TakeMemory(SparseFactor& other) noexcept;

  // x = A⁻¹ b; 0 at fixed axes. Not for two threads at once: it works in its own buffer.
  void Solve(std::span<const glm::dvec3> b, std::span<glm::dvec3> x) noexcept {
    Solve(std::span(&b, 1), std::span(&x, 1));
  }
  // The same for 1 or 3 right-hand sides at once.
  void Solve(std::span<const std::span<const glm::dvec3>> b,
             std::span<const std::span<glm::dvec3>> x) noexcept;

  const FactorPlan& plan() const { return *plan_; }
  const std::shared_ptr<const FactorPlan>& shared_plan() const { return plan_; }

 private:
  bool TryFactor(const BlockMatrix& a, std::span<const double> added, double shift);

  std::shared_ptr<const FactorPlan> plan_;
  std::vector<double> work_;  // panels of L, while factoring
  std::vector<double> inverse_, product_, right_;
  std::vector<int> map_, head_, next_, position_;
  std::vector<float> storage_;
  float* panels_ = nullptr;                    // 64-byte aligned
  std::vector<float> vector_, strip_, short_;  // for three right-hand sides
};

}  // namespace arthro::simulation

#include "simulation/tissue/factor/sparse_factor.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/core/random.h"
#include "simulation/tissue/factor/panel_kernels.h"

namespace arthro::simulation {
namespace {

// Grid of nodes coupled to all neighbours by random blocks, diagonally dominant.
BlockMatrix Grid(int nx, int ny, int nz) {
  auto pattern = std::make_shared<BlockPattern>();
  const auto node = [&](int x, int y, int z) { return (z * ny + y) * nx + x; };
  pattern->row_begin.push_back(0);
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x) {
        for (int c = std::max(z - 1, 0); c <= std::min(z + 1, nz - 1); ++c)
          for (int b = std::max(y - 1, 0); b <= std::min(y + 1, ny - 1); ++b)
            for (int a = std::max(x - 1, 0); a <= std::min(x + 1, nx - 1); ++a) {
              if (a == x && b == y && c == z)
                pattern->diagonal.push_back(static_cast<int>(pattern->column.size()));
              pattern->column.push_back(node(a, b, c));
            }
        pattern->row_begin.push_back(static_cast<int>(pattern->column.size()));
      }
  BlockMatrix matrix{pattern, std::vector<std::array<double, 9>>(pattern->column.size())};
  Random random(7);
  for (int i = 0; i < pattern->node_count(); ++i)
    for (int k = pattern->row_begin[i]; k < pattern->row_begin[i + 1]; ++k) {
      const int j = pattern->column[k];
      if (j < i) continue;
      auto& block = matrix.block[k];
      for (double& value : block) value = random.Uniform(-0.15, 0.15);
      if (j == i) {
        block = {6, block[1], block[2], block[1], 6, block[5], block[2], block[5], 6};
        continue;
      }
      for (int a = 0; a < 3; ++a) block[4 * a] -= 0.2;
      auto& mirror = matrix.block[pattern->Find(j, i)];
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) mirror[3 * b + a] = block[3 * a + b];
    }
  return matrix;
}

struct Solved {
  double residual = 0, shift = 0;
  std::vector<glm::dvec3> x;
};

Solved SolveGrid(const BlockMatrix& a, const FixedAxes& fixed, std::span<const double> added = {}) {
  const auto nodes = static_cast<std::size_t>(a.pattern->node_count());
  SparseFactor factor(std::make_shared<FactorPlan>(a.pattern, fixed));
  Solved solved;
  solved.shift = factor.Factor(a, added);
  std::vector<glm::dvec3> b(nodes), y(nodes);
  solved.x.resize(nodes);
  Random random(3);
  for (glm::dvec3& v : b) v = {random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1)};
  factor.Solve(b, solved.x);
  Multiply(a, solved.x, y);
  double off = 0, all = 0;
  for (std::size_t i = 0; i < nodes; ++i)
    for (int c = 0; c < 3; ++c) {
      const bool is_fixed = !fixed.empty() && (fixed[i] >> c & 1);
      if (is_fixed) {
        EXPECT_EQ(solved.x[i][c], 0.0);
        continue;
      }
      const double r = y[i][c] + (added.empty() ? 0.0 : added[i]) * solved.x[i][c] - b[i][c];
      off += r * r;
      all += b[i][c] * b[i][c];
    }
  solved.residual = std::sqrt(off / all);
  return solved;
}

// The panels are stored as floats: 24 bits, a few sums.
constexpr double kFloatPanels = 2e-6;

TEST(SparseFactor, SolveInvertsTheMatrix) {
  for (const auto& [x, y, z] : {std::array{1, 1, 1}, {2, 1, 1}, {5, 4, 3}, {20, 9, 4}, {9, 9, 9}}) {
    const BlockMatrix a = Grid(x, y, z);
    const Solved solved = SolveGrid(a, {});
    EXPECT_EQ(solved.shift, 0.0);
    EXPECT_LE(solved.residual, kFloatPanels) << x << "x" << y << "x" << z;
  }
}

// 18 thousand axes: memory for the pattern is allocated by its number of entries.
TEST(SparseFactor, PlansMeshesLargerThanAnyTissue) {
  const FactorPlan plan(Grid(45, 15, 9).pattern, {});
  EXPECT_EQ(plan.size(), 3 * 45 * 15 * 9);
  EXPECT_GT(plan.stored(), plan.size());
}

TEST(SparseFactor, LeavesFixedAxesOutIndividually) {
  const BlockMatrix a = Grid(7, 5, 4);
  FixedAxes fixed(7 * 5 * 4, 0);
  for (std::size_t i = 0; i < fixed.size(); ++i)
    fixed[i] = static_cast<std::uint8_t>(i % 11 < 8 ? i % 11 : 0);
  EXPECT_LE(SolveGrid(a, fixed).residual, kFloatPanels);
}

TEST(SparseFactor, AllAxesFixedGivesZero) {
  const BlockMatrix a = Grid(3, 2, 2);
  const Solved solved = SolveGrid(a, FixedAxes(12, 7));
  for (const glm::dvec3& x : solved.x) EXPECT_EQ(x, glm::dvec3(0.0));
}

TEST(SparseFactor, AddsToTheDiagonal) {
  const BlockMatrix a = Grid(6, 5, 4);
  const std::vector<double> added(120, 2.5);
  EXPECT_LE(SolveGrid(a, {}, added).residual, kFloatPanels);
}

TEST(SparseFactor, IndefiniteMatrixIsShiftedUntilPositiveDefinite) {
  BlockMatrix a = Grid(6, 5, 4);
  for (std::size_t i = 0; i < 120; ++i)
    for (int c = 0; c < 3; ++c) a.block[a.pattern->diagonal[i]][4 * c] -= 5.5;
  SparseFactor factor(std::make_shared<FactorPlan>(a.pattern, FixedAxes{}));
  EXPECT_GT(factor.Factor(a, {}), 0.0);
  // xᵀ A⁻¹ x > 0 for the shifted, positive definite matrix.
  std::vector<glm::dvec3> b(120), x(120);
  Random random(5);
  for (int trial = 0; trial < 20; ++trial) {
    double product = 0;
    for (glm::dvec3& v : b)
      v = {random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1)};
    factor.Solve(b, x);
    for (std::size_t i = 0; i < b.size(); ++i)
      product += b[i].x * x[i].x + b[i].y * x[i].y + b[i].z * x[i].z;
    EXPECT_GT(product, 0.0);
  }
}

TEST(SparseFactor, FactorWithinAShiftEndsWhereThatIsTooLittle) {
  BlockMatrix a = Grid(6, 5, 4);
  SparseFactor factor(std::make_shared<FactorPlan>(a.pattern, FixedAxes{}));
  EXPECT_EQ(factor.FactorWithin(a, {}, 1e-3), 0.0);
  for (std::size_t i = 0; i < 120; ++i)
    for (int c = 0; c < 3; ++c) a.block[a.pattern->diagonal[i]][4 * c] -= 5.5;
  const double needed = factor.Factor(a, {});
  ASSERT_GT(needed, 1e-3);
  EXPECT_EQ(factor.FactorWithin(a, {}, 1e-3), -1.0);
  EXPECT_EQ(factor.FactorWithin(a, {}, needed), needed);
}

// Row of 20 × 6 × 6 cells with 8 nodes each; from `cut` on they have separate nodes.
struct Row {
  std::vector<int> cells, parent;  // parent: node of the whole row
  std::shared_ptr<const BlockPattern> Pattern() const {
    return std::make_shared<BlockPattern>(MakePattern(cells, 8, static_cast<int>(parent.size())));
  }
};
Row RowCutAt(int cut) {
  constexpr int kAcross = 7, kAlong = 21;
  Row row;
  for (int i = 0; i < kAlong * kAcross * kAcross; ++i) row.parent.push_back(i);
  const auto copy_of = [&](int node) {
    for (std::size_t i = kAlong * kAcross * kAcross; i < row.parent.size(); ++i)
      if (row.parent[i] == node) return static_cast<int>(i);
    row.parent.push_back(node);
    return static_cast<int>(row.parent.size()) - 1;
  };
  for (int x = 0; x + 1 < kAlong; ++x)
    for (int y = 0; y + 1 < kAcross; ++y)
      for (int z = 0; z + 1 < kAcross; ++z)
        for (int c = 0; c < 8; ++c) {
          const int at = x + (c & 1);
          const int node = (at * kAcross + y + (c >> 1 & 1)) * kAcross + z + (c >> 2);
          row.cells.push_back(x >= cut && at == cut ? copy_of(node) : node);
        }
  return row;
}

TEST(FactorPlan, PlanOfACutBodyKeepsTheOrder) {
  const Row whole = RowCutAt(100), cut = RowCutAt(7);
  const auto before = std::make_shared<const FactorPlan>(whole.Pattern(), FixedAxes{});
  const auto after = UpdatePlan(before, cut.parent, cut.Pattern(), FixedAxes(cut.parent.size(), 0));
  const FactorPlan sought(cut.Pattern(), FixedAxes{});
  EXPECT_EQ(after->size(), 3 * static_cast<int>(cut.parent.size()));
  EXPECT_LE(after->flops(), 1.1 * before->flops()) << "a cut row costs no more than a whole one";
  printf("work of the cut row: %.3g, with an order of its own %.3g, of the whole row %.3g\n",
         after->flops(), sought.flops(), before->flops());

  // Matrix of that pattern: −1 to each neighbour and a dominant diagonal.
  BlockMatrix a{cut.Pattern(), {}};
  for (int i = 0; i < a.pattern->node_count(); ++i)
    for (int k = a.pattern->row_begin[i]; k < a.pattern->row_begin[i + 1]; ++k) {
      const double value = k == a.pattern->diagonal[i] ? 27.5 : -1.0;
      a.block.push_back({value, 0, 0, 0, value, 0, 0, 0, value});
    }
  SparseFactor factor(after);
  ASSERT_EQ(factor.Factor(a, {}), 0.0);
  std::vector<glm::dvec3> x(cut.parent.size()), b(x.size()), y(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = {std::sin(1.0 * i), std::cos(2.0 * i), 1.0};
  Multiply(a, x, b);
  factor.Solve(b, y);
  double off = 0;
  for (std::size_t i = 0; i < x.size(); ++i) off = std::max(off, glm::length(y[i] - x[i]));
  EXPECT_LT(off, 1e-5) << "stored as float";
}

TEST(FactorPlan, PlanIsReusedWhenTheCutChangedNothing) {
  const Row whole = RowCutAt(100);
  const auto before = std::make_shared<const FactorPlan>(whole.Pattern(), FixedAxes{});
  const FixedAxes free(whole.parent.size(), 0);
  EXPECT_EQ(UpdatePlan(before, whole.parent, whole.Pattern(), free), before);
  FixedAxes held = free;
  held[3] = 7;
  EXPECT_EQ(UpdatePlan(before, {}, whole.Pattern(), held)->size(), before->size() - 3);
}

TEST(PanelKernels, SkippedPartsOfAProductChangeNoOtherBit) {
  Random random(3);
  for (const int n : {1, 5, 16, 23, 47}) {
    const int stride = RoundUpToStrip(n);
    const auto made = [&](auto&& is_there) {
      std::vector<double> m(static_cast<std::size_t>(stride * stride + kStrip), 0.0);
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
          if (is_there(i, j)) m[static_cast<std::size_t>(j * stride + i)] = random.Uniform(-1, 1);
      return m;
    };
    const auto full = made([](int, int) { return true; });
    const auto lower = made([](int i, int j) { return i >= j; });
    const auto upper = made([](int i, int j) { return i <= j; });
    const auto expect_same = [&](const std::vector<double>& a, const std::vector<double>& b,
                                 LeftOut left_out) {
      std::vector<double> whole(full.size()), part(full.size());
      MultiplyTransposed(n, n, n, a.data(), stride, b.data(), stride, whole.data(), stride, -1.0,
                         false);
      MultiplyTransposed(n, n, n, a.data(), stride, b.data(), stride, part.data(), stride, -1.0,
                         false, left_out);
      for (int j = 0; j < n; ++j)
        for (int i = left_out == LeftOut::kAboveInC ? j : 0; i < n; ++i) {
          const auto at = static_cast<std::size_t>(j * stride + i);
          ASSERT_EQ(whole[at], part[at]) << n << ": " << i << ", " << j;
        }
    };
    expect_same(lower, full, LeftOut::kAboveInA);
    expect_same(full, lower, LeftOut::kAboveInB);
    expect_same(full, upper, LeftOut::kBelowInB);
    expect_same(full, full, LeftOut::kAboveInC);
  }
}

TEST(SparseFactor, NonFiniteMatrixIsReported) {
  BlockMatrix a = Grid(3, 3, 3);
  a.block[a.pattern->diagonal[4]][4] = std::nan("");
  SparseFactor factor(std::make_shared<FactorPlan>(a.pattern, FixedAxes{}));
  EXPECT_EQ(factor.Factor(a, {}), -1.0);
}

}  // namespace
}  // namespace arthro::simulation

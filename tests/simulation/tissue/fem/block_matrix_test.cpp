#include "simulation/tissue/fem/block_matrix.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "simulation/tissue/fem/element_kernel.h"
#include "tests/simulation/tissue/fem/tissue_bodies.h"

namespace arthro::simulation {
namespace {

TEST(BlockMatrix, ProductEqualsTheSumOverBlocks) {
  const TetMesh mesh = Crescent(2);
  const FemModel model(mesh, Rubber());
  const Assembled a = AssembleAt(model, Shaken(mesh, 1e-4));
  const std::vector<glm::dvec3> x = Shaken(mesh, 1e-3, 9);
  std::vector<glm::dvec3> y(x.size());
  Multiply(a.matrix, x, y);
  double worst = 0;
  for (int row = 0; row < model.node_count(); ++row)
    for (int i = 0; i < 3; ++i) {
      long double sum = 0, size = 0;
      for (int e = model.pattern()->row_begin[row]; e < model.pattern()->row_begin[row + 1]; ++e)
        for (int k = 0; k < 3; ++k) {
          const long double term = static_cast<long double>(a.matrix.block[e][3 * i + k]) *
                                   x[model.pattern()->column[e]][k];
          sum += term;
          size += std::abs(term);
        }
      worst = std::max(worst, static_cast<double>(std::abs(y[row][i] - sum) / size));
    }
  EXPECT_LT(worst, 1e-14);
}

TEST(BlockMatrix, ProductHasTheSameBitsWithEveryInstructionSet) {
  const TetMesh mesh = Crescent(2);
  const FemModel model(mesh, Rubber());
  const Assembled a = AssembleAt(model, Shaken(mesh, 1e-4));
  const std::vector<glm::dvec3> x = Shaken(mesh, 1e-3, 5);
  std::vector<glm::dvec3> best(x.size()), y(x.size());
  Multiply(a.matrix, x, best);
  for (const InstructionSet set : {InstructionSet::kScalar, InstructionSet::kSse2,
                                   InstructionSet::kAvx2, InstructionSet::kAvx512}) {
    const ElementKernel* kernel = KernelOf(set);
    if (kernel == nullptr) continue;
    Multiply(a.matrix, x, y, kernel);
    EXPECT_EQ(y, best) << kernel->name;
  }
}

TEST(BlockMatrix, PatternIncludesUnusedNodesAndHasNoDuplicates) {
  const std::vector<int> elements{0, 1, 2, 4, 1, 2, 4, 5};
  const BlockPattern p = MakePattern(elements, 4, 7);
  EXPECT_EQ(p.node_count(), 7);
  EXPECT_EQ(p.row_begin, (std::vector<int>{0, 4, 9, 14, 15, 20, 24, 25}));
  EXPECT_EQ(p.column[p.diagonal[3]], 3);
  EXPECT_EQ(p.Find(0, 5), -1);
  EXPECT_GE(p.Find(1, 5), 0);
}

}  // namespace
}  // namespace arthro::simulation

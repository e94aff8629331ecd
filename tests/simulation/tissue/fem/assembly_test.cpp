// Energy, force and tangent of whole meshes, for both orders and laws.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "simulation/tissue/fem/element_kernel.h"
#include "tests/simulation/tissue/fem/tissue_bodies.h"
#include "tests/support/allocation_counter.h"

namespace arthro::simulation {
namespace {

class EachOrderAndLaw : public testing::TestWithParam<std::tuple<int, Law>> {
 protected:
  int order() const { return std::get<0>(GetParam()); }
  Law law() const { return std::get<1>(GetParam()); }
};
INSTANTIATE_TEST_SUITE_P(, EachOrderAndLaw,
                         testing::Combine(testing::Values(1, 2),
                                          testing::Values(Law::kStableNeoHookean, Law::kCorotated)),
                         [](const auto& which) {
                           return std::string(std::get<0>(which.param) == 1 ? "T4" : "T10") +
                                  (std::get<1>(which.param) == Law::kCorotated ? "Corotated"
                                                                               : "NeoHookean");
                         });

// Fourth-order differences with h = 1e-4 of an edge: truncation and rounding errors are below 1e-9.
TEST_P(EachOrderAndLaw, ForceAndTangentAreDerivativesOfTheEnergyOnACurvedMesh) {
  const TetMesh mesh = Crescent(order());
  const FemModel model(mesh, Fibred(law()));
  std::vector<glm::dvec3> x = Shaken(mesh, 2e-4);
  const Assembled exact = AssembleAt(model, x);
  const double force_scale = Largest(exact.force);
  double block_scale = 0;
  for (const auto& block : exact.matrix.block)
    for (const double value : block) block_scale = std::max(block_scale, std::abs(value));
  const double h = 5e-7;
  for (int node = 0; node < model.node_count(); node += 17)
    for (int k = 0; k < 3; ++k) {
      const double before = x[node][k];
      std::array<Assembled, 4> moved;
      const std::array<double, 4> step{-2 * h, -h, h, 2 * h};
      for (int s = 0; s < 4; ++s) {
        x[node][k] = before + step[s];
        moved[s] = AssembleAt(model, x, Tangent::kNone);
      }
      x[node][k] = before;
      const auto slope = [&](auto&& value) {
        return (8.0 * (value(2) - value(1)) - (value(3) - value(0))) / (12 * h);
      };
      EXPECT_NEAR(slope([&](int s) { return moved[s].sum.energy; }), -exact.force[node][k],
                  1e-8 * force_scale);
      for (int row = 0; row < model.node_count(); ++row) {
        const glm::dvec3 column = slope([&](int s) { return moved[s].force[row]; });
        const int entry = model.pattern()->Find(row, node);
        for (int i = 0; i < 3; ++i)
          EXPECT_NEAR(column[i], entry < 0 ? 0.0 : -exact.matrix.block[entry][3 * i + k],
                      1e-8 * block_scale);
      }
    }
}

TEST_P(EachOrderAndLaw, RestAndRigidMotionGiveZeroForceAndEnergy) {
  for (const TetMesh& mesh : {Block(order()), Crescent(order())}) {
    const FemModel model(mesh, Fibred(law()));
    const double modulus = 2.2e7;  // matrix and fibres together
    const glm::dmat3 rotation = SomeRotation();
    for (const std::vector<glm::dvec3>& x :
         {mesh.rest_positions, Moved(mesh, [&](const glm::dvec3& at) {
            return rotation * at + glm::dvec3(0.1, -0.2, 0.05);
          })}) {
      const Assembled a = AssembleAt(model, x, Tangent::kNone);
      // Positions of 0.2 m with edges of 1 mm: strain errors of at most 200 ε, 1e-13. The energy
      // has their square and its own rounding, ε.
      EXPECT_LT(std::abs(a.sum.energy), 1e-14 * modulus * model.volume());
      EXPECT_LT(Largest(a.force), 1e-12 * modulus * kSide * kSide);
      EXPECT_EQ(a.sum.inverted, 0);
      EXPECT_NEAR(a.sum.min_ratio, 1, 1e-12);
    }
  }
}

// A linear displacement has the same F everywhere: the energy is volume times Ψ(F), and inner nodes
// feel no force.
TEST_P(EachOrderAndLaw, PatchTestGivesUniformStress) {
  const TetMesh mesh = Block(order());
  const FemModel model(mesh, Rubber(law()));
  const glm::dmat3 f = glm::dmat3(1.1, 0.05, -0.02, 0.1, 0.9, 0.07, -0.04, 0.03, 1.05);
  const Assembled a =
      AssembleAt(model, Moved(mesh, [&](const glm::dvec3& at) { return f * at; }), Tangent::kNone);
  PointJob job{{LameOf(model.material()).mu, LameOf(model.material()).lambda, 0, true},
               law(),
               Tangent::kNone,
               {f[0][0], f[1][0], f[2][0], f[0][1], f[1][1], f[2][1], f[0][2], f[1][2], f[2][2]},
               {}};
  const PointResponse point = KernelOf(InstructionSet::kScalar)->point(job);
  EXPECT_NEAR(a.sum.energy, point.psi * model.volume(), 1e-12 * point.psi * model.volume());
  EXPECT_NEAR(a.sum.min_ratio, point.j, 1e-13);
  EXPECT_NEAR(model.volume(), kSide * kSide * kSide, 1e-15 * kSide);
  const double scale = Largest(a.force);
  for (int i = 0; i < model.node_count(); ++i) {
    const glm::dvec3& at = mesh.rest_positions[i];
    const auto is_inside = [](double c) { return c > 1e-9 && c < kSide - 1e-9; };
    if (!is_inside(at.x) || !is_inside(at.y) || !is_inside(at.z)) continue;
    EXPECT_LT(glm::length(a.force[i]), 1e-12 * scale) << "node " << i;
  }
  // Moment of the forces: at any cross-section the upper half acts on the lower one with P·n A,
  // hence Σ force ⊗ x = −P V.
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) {
      double moment = 0;
      for (int n = 0; n < model.node_count(); ++n)
        moment += a.force[n][i] * mesh.rest_positions[n][k];
      EXPECT_NEAR(moment, -point.p[3 * i + k] * model.volume(), 1e-11 * 1e6 * model.volume());
    }
}

TEST_P(EachOrderAndLaw, MatrixIsExactlySymmetricAndKeepsItsPattern) {
  const TetMesh mesh = Crescent(order());
  const FemModel model(mesh, Fibred(law()));
  for (const Tangent tangent : {Tangent::kTrue, Tangent::kProjected}) {
    const Assembled a = AssembleAt(model, Shaken(mesh, 5e-4), tangent);
    const BlockPattern& p = *model.pattern();
    for (int row = 0; row < p.node_count(); ++row) {
      EXPECT_EQ(p.column[p.diagonal[row]], row);
      EXPECT_TRUE(std::is_sorted(p.column.begin() + p.row_begin[row],
                                 p.column.begin() + p.row_begin[row + 1]));
      for (int e = p.row_begin[row]; e < p.row_begin[row + 1]; ++e) {
        const auto& there = a.matrix.block[e];
        const int back = p.Find(p.column[e], row);
        ASSERT_GE(back, 0);
        for (int i = 0; i < 3; ++i)
          for (int k = 0; k < 3; ++k) ASSERT_EQ(there[3 * i + k], a.matrix.block[back][3 * k + i]);
      }
    }
  }
}

// xᵀ A x ≥ 0 for any x, also for inverted elements.
TEST_P(EachOrderAndLaw, ProjectedMatrixIsPositiveSemidefinite) {
  const TetMesh mesh = Crescent(order());
  const FemModel model(mesh, Fibred(law()));
  const Assembled a = AssembleAt(model, Shaken(mesh, 2e-3), Tangent::kProjected);
  ASSERT_GT(a.sum.inverted, 0);
  Random random(4);
  std::vector<glm::dvec3> x(mesh.rest_positions.size()), y(x.size());
  for (int i = 0; i < 200; ++i) {
    for (glm::dvec3& v : x)
      v = {random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1)};
    Multiply(a.matrix, x, y);
    double product = 0;
    for (std::size_t n = 0; n < x.size(); ++n) product += glm::dot(x[n], y[n]);
    EXPECT_GT(product, 0);
  }
}

TEST_P(EachOrderAndLaw, NonFiniteInputGivesNonFiniteOutput) {
  const TetMesh mesh = Crescent(order());
  const FemModel model(mesh, Fibred(law()));
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL})
    for (const std::size_t node : {std::size_t{0}, mesh.rest_positions.size() - 1}) {
      std::vector<glm::dvec3> x = mesh.rest_positions;
      x[node].y = bad;
      const Assembled a = AssembleAt(model, x, Tangent::kProjected);
      EXPECT_FALSE(std::isfinite(a.sum.energy)) << bad;
      EXPECT_FALSE(AreFinite(a.force)) << bad;
      std::vector<glm::dmat3> rotation(x.size());
      model.NodeRotations(x, rotation);
    }
}

TEST_P(EachOrderAndLaw, AllocatesNothing) {
  const TetMesh mesh = Crescent(order());
  const FemModel model(mesh, Fibred(law()));
  const std::vector<glm::dvec3> x = Shaken(mesh, 1e-4);
  Assembled a = AssembleAt(model, x);
  std::vector<glm::dvec3> y(x.size());
  std::vector<glm::dmat3> rotation(x.size());
  const long before = test::Allocations();
  for (const Tangent tangent : {Tangent::kNone, Tangent::kTrue, Tangent::kProjected})
    model.Assemble(x, law(), tangent, a.force, &a.matrix);
  Multiply(a.matrix, x, y);
  model.NodeRotations(x, rotation);
  EXPECT_EQ(test::Allocations(), before);
}

TEST_P(EachOrderAndLaw, EveryInstructionSetGivesTheSameBits) {
  const TetMesh mesh = Crescent(order());
  const FemModel model(mesh, Fibred(law()));
  for (const double shake : {1e-4, 2e-3})  // the second inverts elements
    for (const Tangent tangent : {Tangent::kNone, Tangent::kTrue, Tangent::kProjected}) {
      const std::vector<glm::dvec3> x = Shaken(mesh, shake);
      const auto all_of = [&](const ElementKernel* kernel) {
        Assembled a = AssembleAt(model, x, tangent, kernel);
        std::vector<glm::dvec3> product(x.size());
        Multiply(a.matrix, x, product, kernel);
        std::vector<glm::dmat3> rotation(x.size());
        model.NodeRotations(x, rotation, kernel);
        return std::tuple(a, product, rotation);
      };
      const auto [a, product, rotation] = all_of(KernelOf(InstructionSet::kScalar));
      for (const InstructionSet set :
           {InstructionSet::kSse2, InstructionSet::kAvx2, InstructionSet::kAvx512}) {
        const ElementKernel* kernel = KernelOf(set);
        if (kernel == nullptr) continue;
        const auto [b, other_product, other_rotation] = all_of(kernel);
        EXPECT_EQ(a.sum.energy, b.sum.energy) << kernel->name;
        EXPECT_EQ(a.sum.min_ratio, b.sum.min_ratio) << kernel->name;
        EXPECT_EQ(a.sum.inverted, b.sum.inverted) << kernel->name;
        EXPECT_TRUE(SameBits(a.force, b.force)) << kernel->name;
        EXPECT_TRUE(SameBits(a.matrix.block, b.matrix.block)) << kernel->name;
        EXPECT_TRUE(SameBits(product, other_product)) << kernel->name;
        EXPECT_TRUE(SameBits(rotation, other_rotation)) << kernel->name;
      }
    }
}

}  // namespace
}  // namespace arthro::simulation

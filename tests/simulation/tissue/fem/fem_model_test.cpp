// Whole meshes: sums over elements, masses, loads, shares, bad input.
#include "simulation/tissue/fem/fem_model.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "app/bench/tissue_meshes.h"
#include "simulation/core/error.h"
#include "simulation/core/random.h"
#include "simulation/tissue/fem/element_kernel.h"
#include "tests/support/allocation_counter.h"

namespace arthro::simulation {
namespace {

constexpr double kSide = 0.01;  // m

Material Rubber(Law law = Law::kStableNeoHookean) {
  Material m;
  m.law = law;
  m.young_modulus = 1e6;
  m.poisson_ratio = 0.45;
  return m;
}
Material Fibred(Law law) {
  Material m = Rubber(law);
  m.fibre_stiffness = 2e7;
  m.fibre_axis = FibreAxis::kCircumferentialZ;
  return m;
}

// A block of 2×2×3 cells, straight.
TetMesh Block(int order) { return app::BlockMesh(order, {2, 2, 3}); }
// A crescent, middle nodes on the curved boundary.
TetMesh Crescent(int order) {
  return app::MeniscusMesh(order, app::MeniscusTicks(app::Cells{6, 2, 1}));
}

std::vector<glm::dvec3> Moved(const TetMesh& mesh,
                              const std::function<glm::dvec3(const glm::dvec3&)>& move) {
  std::vector<glm::dvec3> x;
  for (const glm::dvec3& at : mesh.rest_positions) x.push_back(move(at));
  return x;
}
std::vector<glm::dvec3> Shaken(const TetMesh& mesh, double size, int seed = 1) {
  Random random(seed);
  return Moved(mesh, [&](const glm::dvec3& at) {
    return at + glm::dvec3(random.Uniform(-size, size), random.Uniform(-size, size),
                           random.Uniform(-size, size));
  });
}

struct Assembled {
  Assembly sum;
  std::vector<glm::dvec3> force;
  BlockMatrix matrix;
};
Assembled AssembleAt(const FemModel& model, const std::vector<glm::dvec3>& x,
                     Tangent tangent = Tangent::kTrue, const ElementKernel* kernel = nullptr) {
  Assembled a;
  a.force.resize(x.size());
  a.matrix.pattern = model.pattern();
  a.matrix.block.resize(model.pattern()->column.size());
  a.sum = model.Assemble(x, model.material().law, tangent, a.force, &a.matrix, kernel);
  return a;
}

double Largest(std::span<const glm::dvec3> vectors) {
  double largest = 0;
  for (const glm::dvec3& v : vectors)
    for (int k = 0; k < 3; ++k) largest = std::max(largest, std::abs(v[k]));
  return largest;
}
glm::dvec3 Sum(std::span<const glm::dvec3> vectors) {
  glm::dvec3 sum(0.0);
  for (const glm::dvec3& v : vectors) sum += v;
  return sum;
}
bool AreFinite(std::span<const glm::dvec3> vectors) {
  for (const glm::dvec3& v : vectors)
    for (int k = 0; k < 3; ++k)
      if (!std::isfinite(v[k])) return false;
  return true;
}
template <class T>
bool SameBits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

// Rotation by 40° about (1, 2, 2)/3.
glm::dmat3 SomeRotation() {
  const glm::dvec3 n(1.0 / 3, 2.0 / 3, 2.0 / 3);
  const double c = std::cos(0.7), s = std::sin(0.7);
  glm::dmat3 r;
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i) r[k][i] = (1 - c) * n[i] * n[k] + (i == k ? c : 0);
  r[1][0] -= s * n.z, r[0][1] += s * n.z;
  r[0][2] -= s * n.y, r[2][0] += s * n.y;
  r[2][1] -= s * n.x, r[1][2] += s * n.x;
  return r;
}

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

// Fourth-order differences with h = 1e-4 of an edge: method and rounding both under 1e-9.
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

TEST_P(EachOrderAndLaw, RestAndRigidMotionHaveNoForceAndNoEnergy) {
  for (const TetMesh& mesh : {Block(order()), Crescent(order())}) {
    const FemModel model(mesh, Fibred(law()));
    const double modulus = 2.2e7;  // matrix and fibres together
    const glm::dmat3 rotation = SomeRotation();
    for (const std::vector<glm::dvec3>& x :
         {mesh.rest_positions, Moved(mesh, [&](const glm::dvec3& at) {
            return rotation * at + glm::dvec3(0.1, -0.2, 0.05);
          })}) {
      const Assembled a = AssembleAt(model, x, Tangent::kNone);
      // Positions of 0.2 m over edges of 1 mm: 200 ε of strain at most, 1e-13; energy its square
      // but for rounding of its own, ε.
      EXPECT_LT(std::abs(a.sum.energy), 1e-14 * modulus * model.volume());
      EXPECT_LT(Largest(a.force), 1e-12 * modulus * kSide * kSide);
      EXPECT_EQ(a.sum.inverted, 0);
      EXPECT_NEAR(a.sum.min_ratio, 1, 1e-12);
    }
  }
}

// A linear displacement has the same F everywhere: energy is volume times Ψ(F) and nodes inside
// feel nothing.
TEST_P(EachOrderAndLaw, PatchOfLinearDisplacementHasOneStress) {
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
  const PointAnswer point = KernelOf(InstructionSet::kScalar)->point(job);
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
  // Cut at any height, what the upper half does to the lower one is P·n A: here by the moment of
  // the forces, Σ force ⊗ x = −P V.
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) {
      double moment = 0;
      for (int n = 0; n < model.node_count(); ++n)
        moment += a.force[n][i] * mesh.rest_positions[n][k];
      EXPECT_NEAR(moment, -point.p[3 * i + k] * model.volume(), 1e-11 * 1e6 * model.volume());
    }
}

TEST_P(EachOrderAndLaw, MatrixIsSymmetricToTheBitAndKeepsItsPattern) {
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

// xᵀ A x ≥ 0 for any x, also where elements are inside out.
TEST_P(EachOrderAndLaw, ProjectedMatrixIsPositive) {
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

TEST_P(EachOrderAndLaw, NotFiniteInIsNotFiniteOut) {
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
  for (const double shake : {1e-4, 2e-3})  // the second with elements inside out
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

class EachOrder : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(, EachOrder, testing::Values(1, 2),
                         [](const auto& which) { return which.param == 1 ? "T4" : "T10"; });

TEST_P(EachOrder, CountsElementsThatAreInsideOut) {
  const TetMesh mesh = Block(GetParam());
  const FemModel model(mesh, Rubber());
  const auto mirrored = AssembleAt(
      model, Moved(mesh, [](const glm::dvec3& at) { return glm::dvec3(at.x, at.y, -at.z); }));
  EXPECT_EQ(mirrored.sum.inverted, mesh.ElementCount());
  EXPECT_NEAR(mirrored.sum.min_ratio, -1, 1e-12);
  const auto flat = AssembleAt(
      model, Moved(mesh, [](const glm::dvec3& at) { return glm::dvec3(at.x, at.y, 0); }));
  EXPECT_EQ(flat.sum.inverted, mesh.ElementCount());
  // A corner pulled through the body: the elements at that corner and no others.
  std::vector<glm::dvec3> x = mesh.rest_positions;
  const int corner = mesh.elements[0];
  x[corner] += 3.0 * (glm::dvec3(kSide / 2) - x[corner]);
  int at_corner = 0;
  for (int e = 0; e < mesh.ElementCount(); ++e)
    for (int a = 0; a < 4; ++a)
      at_corner +=
          mesh.elements[static_cast<std::size_t>(e) * mesh.NodesPerElement() + a] == corner;
  const int inverted = AssembleAt(model, x).sum.inverted;
  EXPECT_GT(inverted, 0);
  EXPECT_LE(inverted, at_corner);
}

TEST_P(EachOrder, MassesSumToDensityTimesVolume) {
  for (const TetMesh& mesh : {Block(GetParam()), Crescent(GetParam())}) {
    const FemModel model(mesh, Rubber());
    double sum = 0;
    for (const double m : model.mass()) {
      EXPECT_GT(m, 0);
      sum += m;
    }
    EXPECT_NEAR(sum, 1100 * model.volume(), 1e-13 * sum);
  }
}

TEST_P(EachOrder, BodyForceSumsToItsTotalAndItsMoment) {
  const TetMesh mesh = Block(GetParam());
  const FemModel model(mesh, Rubber());
  std::vector<glm::dvec3> force(mesh.rest_positions.size(), glm::dvec3(0.0));
  const glm::dvec3 b(10, -20, 30);
  model.AddBodyForce(b, force);
  EXPECT_LT(glm::length(Sum(force) - b * model.volume()), 1e-13 * glm::length(b) * model.volume());
  glm::dvec3 centre(0.0);
  for (std::size_t i = 0; i < force.size(); ++i)
    centre += mesh.rest_positions[i] * (force[i].z / (30 * model.volume()));
  EXPECT_LT(glm::length(centre - glm::dvec3(kSide / 2)), 1e-12 * kSide);
}

TEST_P(EachOrder, SurfaceLoadSumsToItsTotalAndIsUniform) {
  const TetMesh mesh = Block(GetParam());
  std::vector<glm::dvec3> force(mesh.rest_positions.size(), glm::dvec3(0.0));
  const glm::dvec3 total(0.1, 0.2, -0.3);
  const double area = AddSurfaceLoad(mesh, mesh.sets.at("top"), total, force);
  EXPECT_NEAR(area, kSide * kSide, 1e-13 * area);
  EXPECT_LT(glm::length(Sum(force) - total), 1e-14);
  glm::dvec3 centre(0.0);
  for (std::size_t i = 0; i < force.size(); ++i) {
    if (!mesh.sets.at("top")[i]) {
      EXPECT_EQ(force[i], glm::dvec3(0.0));
    }
    centre += mesh.rest_positions[i] * (force[i].z / total.z);
  }
  EXPECT_LT(glm::length(centre - glm::dvec3(kSide / 2, kSide / 2, kSide)), 1e-12 * kSide);
  std::vector<unsigned char> one_node(mesh.rest_positions.size(), 0);
  one_node[0] = 1;
  EXPECT_EQ(AddSurfaceLoad(mesh, one_node, total, force), 0);
}

// Inner faces of the mesh bear nothing, though all their corners are in the set.
TEST_P(EachOrder, SurfaceLoadActsOnTheBoundaryOnly) {
  const TetMesh mesh = Block(GetParam());
  std::vector<glm::dvec3> force(mesh.rest_positions.size(), glm::dvec3(0.0));
  const std::vector<unsigned char> all(mesh.rest_positions.size(), 1);
  EXPECT_NEAR(AddSurfaceLoad(mesh, all, {0, 0, 1}, force), 6 * kSide * kSide, 1e-12 * kSide);
}

TEST_P(EachOrder, SharesScaleWhatIsThere) {
  const TetMesh mesh = Crescent(GetParam());
  const FemModel whole(mesh, Fibred(Law::kStableNeoHookean));
  FemModel half = whole;
  const std::size_t points =
      static_cast<std::size_t>(mesh.ElementCount()) * whole.points_per_element();
  half.SetShares(std::vector<double>(points, 0.5));
  const std::vector<glm::dvec3> x = Shaken(mesh, 1e-4);
  const Assembled a = AssembleAt(whole, x), b = AssembleAt(half, x);
  EXPECT_NEAR(b.sum.energy, 0.5 * a.sum.energy, 1e-14 * a.sum.energy);
  EXPECT_NEAR(half.volume(), 0.5 * whole.volume(), 1e-14 * whole.volume());
  for (int i = 0; i < whole.node_count(); ++i) {
    EXPECT_LT(glm::length(b.force[i] - 0.5 * a.force[i]), 1e-13 * Largest(a.force));
    EXPECT_NEAR(half.mass()[i], 0.5 * whole.mass()[i], 1e-14 * whole.mass()[i]);
  }
}

// Elements of no share are as if they were not there: the rest answers as the mesh of the rest,
// their own nodes keep a mass above nothing, and inside out they do not count.
TEST_P(EachOrder, WhatHasNoShareIsGone) {
  const TetMesh mesh = Block(GetParam());
  const int n = mesh.NodesPerElement(), points = n == 10 ? 4 : 1, kept = mesh.ElementCount() - 13;
  std::vector<double> share(static_cast<std::size_t>(mesh.ElementCount()) * points, 1.0);
  std::fill(share.begin() + static_cast<std::size_t>(kept) * points, share.end(), 0.0);
  const FemModel cut(mesh, Rubber(), share);
  TetMesh rest = mesh;
  rest.elements.resize(static_cast<std::size_t>(kept) * n);
  const FemModel alone(rest, Rubber());
  const std::vector<glm::dvec3> x = Shaken(mesh, 3e-4);
  const Assembled a = AssembleAt(cut, x), b = AssembleAt(alone, x);
  EXPECT_EQ(a.sum.energy, b.sum.energy);
  EXPECT_EQ(a.sum.min_ratio, b.sum.min_ratio);
  EXPECT_TRUE(SameBits(a.force, b.force));
  EXPECT_NEAR(cut.volume(), alone.volume(), 1e-15 * alone.volume());
  for (const double m : cut.mass()) EXPECT_GT(m, 0);
  std::vector<glm::dvec3> mirrored = x;
  for (glm::dvec3& at : mirrored) at.z = -at.z;
  EXPECT_LE(AssembleAt(cut, mirrored).sum.inverted, kept);
}

TEST_P(EachOrder, NodeRotationsFollowARigidOneAndStayProperWhenFlat) {
  const TetMesh mesh = Crescent(GetParam());
  const FemModel model(mesh, Rubber());
  const glm::dmat3 turn = SomeRotation();
  std::vector<glm::dmat3> rotation(mesh.rest_positions.size());
  model.NodeRotations(Moved(mesh, [&](const glm::dvec3& at) { return turn * at; }), rotation);
  for (const glm::dmat3& r : rotation)
    for (int k = 0; k < 3; ++k) EXPECT_LT(glm::length(r[k] - turn[k]), 1e-12);
  for (const double height : {-1.0, 0.0, 1e-9}) {
    model.NodeRotations(
        Moved(mesh, [&](const glm::dvec3& at) { return glm::dvec3(at.x, at.y, height * at.z); }),
        rotation);
    for (const glm::dmat3& r : rotation) {
      EXPECT_NEAR(glm::dot(glm::cross(r[0], r[1]), r[2]), 1, 1e-12);
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(glm::length(r[k]), 1, 1e-12);
    }
  }
  model.NodeRotations(std::vector<glm::dvec3>(mesh.rest_positions.size(), glm::dvec3(0.0)),
                      rotation);
  for (const glm::dmat3& r : rotation)
    EXPECT_NEAR(glm::dot(glm::cross(r[0], r[1]), r[2]), 1, 1e-12);
}

// Hinton, Rock & Zienkiewicz: corners of a straight T10 have 1/36 of its mass each, middles 4/27.
TEST(FemModel, LumpsAStraightT10AsTheExactIntegralsSay) {
  TetMesh mesh;
  mesh.order = 2;
  mesh.rest_positions = {{0, 0, 0},     {1, 0, 0},   {0, 1, 0},   {0, 0, 1},     {0.5, 0, 0},
                         {0.5, 0.5, 0}, {0, 0.5, 0}, {0, 0, 0.5}, {0.5, 0, 0.5}, {0, 0.5, 0.5}};
  mesh.elements = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
  const FemModel model(mesh, Rubber());
  for (int i = 0; i < 10; ++i)
    EXPECT_NEAR(model.mass()[i], 1100.0 / 6 * (i < 4 ? 1.0 / 36 : 4.0 / 27), 1e-10);
}

TEST(FemModel, RefusesWhatCannotBeComputedWith) {
  const TetMesh mesh = Block(1);
  const auto says = [&](const TetMesh& m, const Material& material,
                        std::span<const double> share = {}) -> std::string {
    try {
      FemModel(m, material, share);
    } catch (const Error& error) {
      return error.what();
    }
    return "nothing";
  };
  const auto changed = [](auto change) {
    Material m;
    change(m);
    return m;
  };
  EXPECT_NE(says(mesh, changed([](Material& m) { m.poisson_ratio = 0.5; })).find("Poisson"),
            std::string::npos);
  EXPECT_NE(says(mesh, changed([](Material& m) { m.young_modulus = 0; })).find("Young"),
            std::string::npos);
  EXPECT_NE(says(mesh, changed([](Material& m) { m.young_modulus = std::nan(""); })).find("Young"),
            std::string::npos);
  EXPECT_NE(says(mesh, changed([](Material& m) { m.density = -1; })).find("density"),
            std::string::npos);
  EXPECT_NE(says(mesh, changed([](Material& m) { m.fibre_stiffness = HUGE_VAL; })).find("fibre"),
            std::string::npos);
  EXPECT_NE(says(mesh, Material{}, std::vector<double>{1, 1}).find("shares"), std::string::npos);
  std::vector<double> share(mesh.ElementCount(), 1.0);
  share[3] = 1.5;
  EXPECT_NE(says(mesh, Material{}, share).find("quadrature point 3"), std::string::npos);
  TetMesh flat = mesh;
  for (int a = 1; a < 4; ++a)
    flat.rest_positions[flat.elements[4 * 7 + a]].z = flat.rest_positions[flat.elements[4 * 7]].z;
  EXPECT_NE(says(flat, Material{}).find("no volume"), std::string::npos);
  TetMesh stray = mesh;
  stray.elements[5] = 100000;
  EXPECT_NE(says(stray, Material{}).find("100000"), std::string::npos);
  EXPECT_NE(says(TetMesh{}, Material{}).find("elements"), std::string::npos);
}

TEST(BlockMatrix, MultipliesAsTheSumOfItsBlocks) {
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

TEST(BlockMatrix, PatternHasNodesOfNoElementAndNothingTwice) {
  const std::vector<int> elements{0, 1, 2, 4, 1, 2, 4, 5};
  const BlockPattern p = PatternOf(elements, 4, 7);
  EXPECT_EQ(p.node_count(), 7);
  EXPECT_EQ(p.row_begin, (std::vector<int>{0, 4, 9, 14, 15, 20, 24, 25}));
  EXPECT_EQ(p.column[p.diagonal[3]], 3);
  EXPECT_EQ(p.Find(0, 5), -1);
  EXPECT_GE(p.Find(1, 5), 0);
}

}  // namespace
}  // namespace arthro::simulation

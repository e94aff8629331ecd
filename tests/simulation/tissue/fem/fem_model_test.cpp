// Masses, loads, shares, rotations and invalid input.
#include "simulation/tissue/fem/fem_model.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "simulation/core/error.h"
#include "tests/simulation/tissue/fem/tissue_bodies.h"

namespace arthro::simulation {
namespace {

class EachOrder : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(, EachOrder, testing::Values(1, 2),
                         [](const auto& which) { return which.param == 1 ? "T4" : "T10"; });

TEST_P(EachOrder, CountsInvertedElements) {
  const TetMesh mesh = Block(GetParam());
  const FemModel model(mesh, Rubber());
  const auto mirrored = AssembleAt(
      model, Moved(mesh, [](const glm::dvec3& at) { return glm::dvec3(at.x, at.y, -at.z); }));
  EXPECT_EQ(mirrored.sum.inverted, mesh.ElementCount());
  EXPECT_NEAR(mirrored.sum.min_ratio, -1, 1e-12);
  const auto flat = AssembleAt(
      model, Moved(mesh, [](const glm::dvec3& at) { return glm::dvec3(at.x, at.y, 0); }));
  EXPECT_EQ(flat.sum.inverted, mesh.ElementCount());
  // Pulls a corner through the body, which inverts the elements at that corner only.
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

TEST_P(EachOrder, BodyForceHasTheRightTotalAndMoment) {
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

TEST_P(EachOrder, SurfaceLoadHasTheRightTotalAndIsUniform) {
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

// Inner faces carry no load, although all their corners are in the set.
TEST_P(EachOrder, SurfaceLoadActsOnTheBoundaryOnly) {
  const TetMesh mesh = Block(GetParam());
  std::vector<glm::dvec3> force(mesh.rest_positions.size(), glm::dvec3(0.0));
  const std::vector<unsigned char> all(mesh.rest_positions.size(), 1);
  EXPECT_NEAR(AddSurfaceLoad(mesh, all, {0, 0, 1}, force), 6 * kSide * kSide, 1e-12 * kSide);
}

TEST_P(EachOrder, SharesScaleEnergyForceAndMass) {
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

TEST_P(EachOrder, ChangedSharesEqualANewModelBitForBit) {
  const TetMesh mesh = Block(GetParam());
  FemModel whole(mesh, Rubber());
  std::vector<double> share(whole.shares().size());
  for (std::size_t i = 0; i < share.size(); ++i) share[i] = 1.0 / static_cast<double>(1 + i % 7);
  const FemModel made(mesh, Rubber(), share);
  FemModel copy = whole;
  copy.SetShares(share);
  const auto x = Moved(mesh, [](const glm::dvec3& at) { return at + 0.1 * at.y * at; });
  const auto a = AssembleAt(made, x), b = AssembleAt(copy, x);
  EXPECT_EQ(a.sum.energy, b.sum.energy);
  EXPECT_EQ(a.force, b.force);
  EXPECT_TRUE(std::ranges::equal(made.mass(), copy.mass()));
}

// Elements with zero share have no effect: the rest answers like a mesh of the rest. Their own
// nodes keep a positive mass, and inverted ones do not count.
TEST(FemModel, NodeSharesAreTheRemainingVolumeFractions) {
  TetMesh mesh;
  mesh.order = 1;
  mesh.rest_positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -3}};
  mesh.elements = {0, 1, 2, 3, 0, 2, 1, 4};
  FemModel model(mesh, Material{});
  for (const double share : model.NodeShares()) EXPECT_EQ(share, 1.0);
  model.SetShares(std::vector<double>{0.2, 1.0});
  const std::vector<double> share = model.NodeShares();
  EXPECT_NEAR(share[3], 0.2, 1e-15);
  EXPECT_NEAR(share[4], 1.0, 1e-15);
  EXPECT_NEAR(share[0], (0.2 * 1 + 3) / 4, 1e-15) << "by volume";
}

TEST_P(EachOrder, ElementsWithZeroShareHaveNoEffect) {
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

TEST_P(EachOrder, NodeRotationsFollowARigidRotationAndStayProperWhenFlat) {
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
  // A point, or a line along x, does not determine a rotation: expects the identity.
  for (const double width : {0.0, 1.0}) {
    model.NodeRotations(
        Moved(mesh, [&](const glm::dvec3& at) { return glm::dvec3(width * at.x, 0, 0); }),
        rotation);
    for (const glm::dmat3& r : rotation)
      for (int k = 0; k < 3; ++k) EXPECT_LT(glm::length(r[k] - glm::dmat3(1.0)[k]), 1e-12);
  }
}

// Hinton, Rock & Zienkiewicz: corners of a straight T10 have 1/36 of its mass each, midpoints 4/27.
TEST(FemModel, LumpedMassOfAStraightT10EqualsTheExactIntegrals) {
  TetMesh mesh;
  mesh.order = 2;
  mesh.rest_positions = {{0, 0, 0},     {1, 0, 0},   {0, 1, 0},   {0, 0, 1},     {0.5, 0, 0},
                         {0.5, 0.5, 0}, {0, 0.5, 0}, {0, 0, 0.5}, {0.5, 0, 0.5}, {0, 0.5, 0.5}};
  mesh.elements = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
  const FemModel model(mesh, Rubber());
  for (int i = 0; i < 10; ++i)
    EXPECT_NEAR(model.mass()[i], 1100.0 / 6 * (i < 4 ? 1.0 / 36 : 4.0 / 27), 1e-10);
}

TEST(FemModel, RefusesInvalidMaterialsAndMeshes) {
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

}  // namespace
}  // namespace arthro::simulation

// Geometric part of the cases FEM-13 to FEM-15, and the many cuts of FEM-22.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <malloc.h>
#include <memory>
#include <numeric>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/core/units.h"
#include "simulation/tissue/cut/cutters.h"
#include "simulation/tissue/fem/fem_model.h"
#include "simulation/tissue/field/pieces.h"
#include "simulation/tissue/field/polygonise.h"
#include "simulation/tissue/solver/implicit_solver.h"
#include "tests/simulation/tissue/cut/cut_checks.h"
#include "tests/simulation/tissue/cut/mesh_boundary.h"
#include "tests/simulation/tissue/field/closed_manifold.h"

namespace arthro::simulation {
namespace {

using Shape = std::function<double(const glm::dvec3&)>;

double SumOf(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

// A piece cut free is detected, with its volume and momentum.
TEST(Fem13, PieceCutFreeIsDetectedAndKeepsVolumeAndMomentum) {
  for (const int order : {1, 2}) {
    const TetMesh whole = test::CutBlock(order);
    const double volume = FemModel(whole, {}).volume();
    SolidField field = test::CutBlockField();
    MeshCutter cutter(whole, field.spacing());
    const FieldEdit edit = field.Subtract(
        field.box(), [](const glm::dvec3& x) { return std::abs(x.x - 8.3 * kMm) - 0.4 * kMm; });
    const CutMesh& cut = cutter.Update(field, edit.changed);
    test::ExpectSound(cut, whole);
    ASSERT_EQ(cut.piece_count(), 2);
    EXPECT_NEAR(SumOf(cut.piece_volume) + cut.removed_volume, volume, 1e-12 * volume);
    // The body is held at x = 0: the field reports the same piece as loose.
    const FieldPieces pieces = PiecesOf(field);
    ASSERT_EQ(pieces.count(), 2);
    const std::vector<Ball> anchors{{glm::dvec3(0, 4, 2) * kMm, 1 * kMm}};
    EXPECT_EQ(HeldPieces(field, pieces, anchors), (std::vector<unsigned char>{1, 0}));
    EXPECT_NEAR(cut.piece_volume[1], pieces.volume[1], 0.03 * pieces.volume[1]);

    // The body rotates and drifts during the cut: velocities are passed on node by node. The
    // momentum of each piece equals that of its tissue by quadrature.
    Material material;
    const glm::dvec3 drift(0.3, -0.2, 0.1);
    const FemModel model(cut.mesh, material, cut.solid_share);
    std::vector<glm::dvec3> velocity_before(whole.rest_positions.size(), drift);
    glm::dvec3 momentum(0), of_free_piece(0);
    const std::set<int> free_nodes = test::NodesOfPiece(cut, 1);
    for (std::size_t i = 0; i < cut.previous_node.size(); ++i) {
      ASSERT_GE(cut.previous_node[i], 0);
      const glm::dvec3 p =
          model.mass()[i] * velocity_before[static_cast<std::size_t>(cut.previous_node[i])];
      momentum += p;
      if (free_nodes.contains(static_cast<int>(i))) of_free_piece += p;
    }
    const double mass = material.density * SumOf(cut.piece_volume);
    EXPECT_LT(glm::length(momentum - mass * drift), 1e-12 * mass);
    EXPECT_LT(glm::length(of_free_piece - material.density * cut.piece_volume[1] * drift),
              1e-12 * mass)
        << "no mass moves between the pieces";
    // No force crosses the cut: moving the free piece as a whole causes no strain.
    std::vector<glm::dvec3> x = cut.mesh.rest_positions, force(x.size());
    for (const int node : free_nodes) x[static_cast<std::size_t>(node)].x += 5 * kMm;
    const Assembly assembly = model.Assemble(x, material.law, Tangent::kNone, force, nullptr);
    EXPECT_LT(assembly.energy, 1e-12 * material.young_modulus * volume);
    // A small enough piece counts as debris.
    CutOptions options;
    options.crumb_volume = 1.1 * cut.piece_volume[1];
    const CutMesh clean = CutByField(whole, field, options);
    EXPECT_EQ(clean.piece_count(), 1);
    EXPECT_EQ(clean.crumbs, 1);
    EXPECT_NEAR(clean.crumb_volume, cut.piece_volume[1], 1e-12 * volume);
    EXPECT_NEAR(SumOf(clean.piece_volume) + clean.removed_volume, volume, 1e-12 * volume);
  }
}

struct Plane {
  const char* name;
  glm::dvec3 normal;
  double offset;  // m
};

// Planes that pass exactly through vertices, edges and faces of the mesh. The same planes moved by
// ±1e-9 m must give the same mesh. The field's 32-bit values have errors of up to that size.
TEST(Fem14, DegeneratePlanesGiveTheTopologyOfShiftedPlanes) {
  const double d = 1 / std::sqrt(2.0), t = 1 / std::sqrt(3.0);
  const std::vector<Plane> planes{
      {"coplanar with faces", {1, 0, 0}, 6 * kMm},
      {"coplanar with faces, the other way", {0, 0, -1}, -2 * kMm},
      {"coplanar with diagonal faces", {d, -d, 0}, 0},
      {"through edges and diagonals", {d, d, 0}, 8 * kMm * d},
      {"through vertices", {t, t, t}, 8 * kMm * t},
      {"through vertices, slanted", glm::normalize(glm::dvec3(1, 2, 0.5)), 0},
      {"through mid nodes", {1, 0, 0}, 5 * kMm},
  };
  for (const int order : {1, 2})
    for (const Plane& plane : planes) {
      const TetMesh whole = test::CutBlock(order);
      const FemModel model(whole, {});
      const double volume = model.volume();
      double offset = plane.offset;
      if (offset == 0) offset = glm::dot(plane.normal, glm::dvec3(6, 4, 2) * kMm);
      const auto cut_at = [&](double moved) {
        SolidField field = test::CutBlockField();
        field.Subtract(field.box(), [&](const glm::dvec3& x) {
          return offset + moved - glm::dot(plane.normal, x);
        });
        return CutByField(whole, field);
      };
      const CutMesh cut = cut_at(0);
      test::ExpectSound(cut, whole);
      EXPECT_GT(cut.mesh.ElementCount(), 20) << plane.name;
      EXPECT_LT(cut.mesh.ElementCount(), whole.ElementCount()) << plane.name;
      EXPECT_EQ(cut.piece_count(), 1) << plane.name;
      for (const double moved : {1e-9, -1e-9}) {
        const CutMesh other = cut_at(moved);
        EXPECT_TRUE(test::SameTopology(cut, other)) << plane.name << " moved by " << moved;
        EXPECT_NEAR(SumOf(other.piece_volume), SumOf(cut.piece_volume), 1e-5 * volume)
            << plane.name;
      }
      EXPECT_NEAR(SumOf(cut.piece_volume) + cut.removed_volume, volume, 1e-12 * volume);
      // Each tetrahedron is a whole one of the mesh, with positive volume and a valid model.
      const FemModel cut_model(cut.mesh, {}, cut.share);
      for (const double mass : cut_model.mass()) EXPECT_GT(mass, 0.0);
      if (plane.normal.x == 1) {
        EXPECT_NEAR(SumOf(cut.piece_volume), offset * 32 * kMm * kMm, 1e-6 * volume)
            << "a plane is cut exactly";
      }
    }
}

// Two slots that cross exactly along mesh edges.
TEST(Fem14, CrossingSlotsOnFacesSplitTheBlockInFour) {
  const TetMesh whole = test::CutBlock(2);
  const double volume = FemModel(whole, {}).volume();
  SolidField field = test::CutBlockField();
  for (const int axis : {0, 1})
    field.Subtract(field.box(), [&](const glm::dvec3& x) {
      return std::abs(x[axis] - (axis == 0 ? 6 : 4) * kMm) - 0.3 * kMm;
    });
  const CutMesh cut = CutByField(whole, field);
  test::ExpectSound(cut, whole);
  ASSERT_EQ(cut.piece_count(), 4);
  for (const double v : cut.piece_volume)
    EXPECT_NEAR(v, 5.7 * 3.7 * 4 * kMm3, 0.01 * 5.7 * 3.7 * 4 * kMm3);
  EXPECT_NEAR(SumOf(cut.piece_volume) + cut.removed_volume, volume, 1e-12 * volume);
}

// The two remaining parts touch only along an edge of the mesh, or at one node.
TEST(Fem15, HingeOfAnEdgeOrANodeComesApart) {
  for (const int order : {1, 2}) {
    const TetMesh whole = test::CutBlock(order);
    const glm::dvec3 middle = glm::dvec3(6, 4, 2) * kMm;
    const auto taken_away = [&](int axes) {
      // Removes all but two opposite quadrants (octants) about `middle`.
      return [=](const glm::dvec3& x) {
        double low = -1e3, high = -1e3;
        for (int a = 0; a < axes; ++a) {
          low = std::max(low, x[a] - middle[a]);
          high = std::max(high, middle[a] - x[a]);
        }
        return -std::min(low, high);  // positive in both remaining parts
      };
    };
    for (const int axes : {2, 3}) {
      SolidField field = test::CutBlockField();
      field.Subtract(field.box(), taken_away(axes));
      const CutMesh cut = CutByField(whole, field);
      test::ExpectSound(cut, whole);
      ASSERT_EQ(cut.piece_count(), 2) << axes;
      const std::set<int> first = test::NodesOfPiece(cut, 0), second = test::NodesOfPiece(cut, 1);
      for (const int node : first) EXPECT_FALSE(second.contains(node));
      // The nodes of the hinge are duplicated.
      std::vector<int> there(whole.rest_positions.size(), 0);
      for (const int parent : cut.parent_node) ++there[static_cast<std::size_t>(parent)];
      EXPECT_EQ(*std::max_element(there.begin(), there.end()), 2);
      // Rotating each piece about the hinge causes no strain.
      const FemModel model(cut.mesh, {}, cut.share);
      std::vector<glm::dvec3> x = cut.mesh.rest_positions, force(x.size());
      const double angle = 0.5;
      for (const int node : second) {
        glm::dvec3& p = x[static_cast<std::size_t>(node)];
        const glm::dvec3 r = p - middle;
        p = middle + glm::dvec3(std::cos(angle) * r.x - std::sin(angle) * r.y,
                                std::sin(angle) * r.x + std::cos(angle) * r.y, r.z);
      }
      const Assembly assembly =
          model.Assemble(x, Law::kStableNeoHookean, Tangent::kNone, force, nullptr);
      EXPECT_LT(assembly.energy, 1e-10 * Material().young_modulus * model.volume());
    }
  }
}

// A hinge anywhere in the elements: whether or not it holds, all values stay finite.
TEST(Fem15, HingeInsideElementsStaysFinite) {
  const TetMesh whole = test::CutBlock(2);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> any(-1, 1);
  int apart = 0;
  for (int trial = 0; trial < 8; ++trial) {
    const glm::dvec3 middle = glm::dvec3(6 + any(random), 4 + any(random), 2) * kMm;
    SolidField field = test::CutBlockField();
    field.Subtract(field.box(), [&](const glm::dvec3& x) {
      return -std::min(std::max(x.x - middle.x, x.y - middle.y),
                       std::max(middle.x - x.x, middle.y - x.y));
    });
    const CutMesh cut = CutByField(whole, field);
    test::ExpectSound(cut, whole);
    EXPECT_LE(cut.piece_count(), 2);
    apart += cut.piece_count() == 2;
    const FemModel model(cut.mesh, {}, cut.share);
    for (const double mass : model.mass()) EXPECT_GT(mass, 0.0);
    EXPECT_TRUE(std::isfinite(model.volume()));
  }
  std::printf("hinges inside elements: %d of 8 came apart\n", apart);
}

// Elements with a hundredth of their volume left must not spoil the system's condition.
TEST(Fem22, CutBodiesNeedAboutAsManyIterationsAsWholeOnes) {
  const TetMesh whole = test::MeniscusMesh(2, test::MeniscusTicks({16, 3, 2}));
  SolidField field = SolidField::FromSurface(test::BoundaryOf(whole), 0.35 * kMm);
  MeshCutter cutter(whole, field.spacing());
  std::mt19937 random(5);
  int of_whole = 0;
  for (int cuts = 0; cuts <= 120; cuts += 40) {
    for (int i = 0; cuts > 0 && i < 40; ++i) {
      const glm::dvec3 at =
          whole.rest_positions[static_cast<std::size_t>(random() % whole.rest_positions.size())];
      cutter.Update(field, Apply(field, CapsuleCut{at, at + glm::dvec3(0, 0, 1e-3), kMm}).changed);
    }
    const CutMesh& cut = cutter.result();
    FixedAxes fixed;
    for (const std::uint8_t is_horn : cut.mesh.sets.at("horns"))
      fixed.push_back(is_horn != 0 ? 7 : 0);
    ImplicitSolver solver(std::make_shared<FemModel>(cut.mesh, Material(), cut.share), fixed);
    BodyState state{cut.mesh.rest_positions,
                    std::vector<glm::dvec3>(cut.mesh.rest_positions.size(), glm::dvec3(0))};
    std::vector<glm::dvec3> load(state.x.size(), glm::dvec3(0));
    FemModel(cut.mesh, Material(), cut.share).AddBodyForce({0, 0, -1100 * 9.81}, load);
    StepReport worst;
    for (int step = 0; step < 20; ++step) {
      const StepReport report = solver.Step(state, load, {}, {}, 1.0 / 60, {});
      ASSERT_TRUE(report.is_finite) << cuts;
      EXPECT_EQ(report.inverted, 0) << cuts;
      worst.iterations = std::max(worst.iterations, report.iterations);
      worst.residual = std::max(worst.residual, report.residual);
    }
    std::printf("%3d bites, %d pieces: %d iterations per step at most, residual %.1e\n", cuts,
                cut.piece_count(), worst.iterations, worst.residual);
    if (cuts == 0) of_whole = worst.iterations;
    EXPECT_LE(worst.residual, SolverOptions().tolerance);
    EXPECT_LE(worst.iterations, std::max(60, 4 * of_whole));
  }
}

// 0 to 200 cuts of all kinds, twice from the original: the mesh is valid after each cut, and the
// second round leaves as much on the heap as the first.
TEST(Fem22, TwoHundredCutsKeepAValidMeshAndFlatMemory) {
  const TetMesh whole = test::MeniscusMesh(2, test::MeniscusTicks({16, 3, 2}));
  const double volume = FemModel(whole, {}).volume();
  const SolidField original = SolidField::FromSurface(test::BoundaryOf(whole), 0.35 * kMm);
  std::size_t in_use[2] = {};
  int most_pieces = 0, crumbs = 0;
  for (int round = 0; round < 2; ++round) {
    SolidField field = original;
    MeshCutter cutter(whole, field.spacing());
    FieldSkin skin(field);
    std::mt19937 random(23);
    std::uniform_real_distribution<double> any(-1, 1);
    double last_removed = 0;
    for (int i = 0; i < 200; ++i) {
      const glm::dvec3 at =
          whole.rest_positions[static_cast<std::size_t>(random() % whole.rest_positions.size())];
      const glm::dvec3 way = glm::dvec3(any(random), any(random), any(random)) * kMm;
      FieldEdit edit;
      if (i % 3 == 0)
        edit = Apply(field, CapsuleCut{at, at + way, (0.9 + 0.5 * any(random)) * kMm});
      else if (i % 3 == 1)
        edit = Apply(field, TearCut{{at - 2.0 * way, at + 2.0 * way + glm::dvec3(1e-6)},
                                    {0, 0, -1},
                                    4 * kMm,
                                    0.5 * kMm,
                                    4 * kMm});
      else
        edit = Apply(field, BoxCut{{glm::angleAxis(3 * any(random), glm::dvec3(0, 0, 1)), at},
                                   glm::dvec3(0.8, 0.4, 0.6) * kMm});
      const CutMesh& cut = cutter.Update(field, edit.changed);
      skin.Update(field);
      if (round > 0) continue;
      test::ExpectSound(cut, whole);
      if (HasFatalFailure()) FAIL() << "after cut " << i;
      ASSERT_NEAR(SumOf(cut.piece_volume) + cut.removed_volume, volume, 1e-12 * volume) << i;
      ASSERT_GE(cut.removed_volume, last_removed - 1e-12 * volume) << i;
      last_removed = cut.removed_volume;
      most_pieces = std::max(most_pieces, cut.piece_count());
      crumbs = std::max(crumbs, cut.crumbs);
      for (const int previous : cut.previous_node) ASSERT_GE(previous, 0) << i;
      if (i % 40 == 39) {
        if (cut.mesh.ElementCount() > 0) {
          const FemModel model(cut.mesh, {}, cut.share);
          for (const double mass : model.mass()) ASSERT_TRUE(mass > 0 && std::isfinite(mass));
        }
        const test::SurfaceFaults faults = test::FaultsOf(skin.surface());
        ASSERT_EQ(faults.edges + faults.vertices, 0) << i;
        ASSERT_TRUE(test::SameTopology(cut, CutByField(whole, field))) << i;
      }
    }
    in_use[round] = mallinfo2().uordblks;
    if (round == 0)
      std::printf("200 cuts: %.0f %% removed, up to %d pieces, %d crumbs, %d of %d elements left\n",
                  100 * cutter.result().removed_volume / volume, most_pieces, crumbs,
                  cutter.result().mesh.ElementCount(), whole.ElementCount());
  }
  std::printf("heap after each round of 200: %.2f, %.2f MB\n", 1e-6 * in_use[0], 1e-6 * in_use[1]);
  EXPECT_GT(most_pieces, 3);
  EXPECT_LE(static_cast<double>(in_use[1]), 1.01 * static_cast<double>(in_use[0]));
}

}  // namespace
}  // namespace arthro::simulation

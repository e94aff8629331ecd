#include "authoring/tissue/tetrahedra/mesh_budget.h"

#include <cmath>
#include <cstdio>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "authoring/tissue/surface/surface_simplify.h"
#include "simulation/core/error.h"
#include "tests/support/build_paths.h"
#include "tests/support/shapes.h"

namespace arthro::authoring {
namespace {

using test::Sphere;
using test::Torus;

TetMesh Fill(const SurfaceMesh& surface, MeshSize size, const std::vector<Ball>& fixed,
             TetrahedralizeReport* report = nullptr) {
  MeshWish wish;
  wish.elements = BudgetOf(size).elements;
  wish.fixed = fixed;
  return TetrahedralizeToBudget(surface, {}, wish, report, {}, ARTHRO_PROGRAM);
}

TEST(MeshBudget, MakesAboutTheGivenNumberOfQuadraticElements) {
  const SurfaceMesh torus = Torus(0.015, 0.004, 60, 24);
  for (const MeshBudget& budget : MeshBudgets()) {
    TetrahedralizeReport report;
    const TetMesh mesh = Fill(torus, budget.size, {{{0.019, 0, 0}, 0.003}}, &report);
    std::printf("%s: %d elements, volume off by %.2g, worst det %.2f, angles from %.1f deg\n",
                budget.name, mesh.ElementCount(), report.volume_error,
                report.quality.worst_jacobian, report.quality.min_dihedral * 57.29578);
    EXPECT_EQ(mesh.order, 2);
    EXPECT_NEAR(mesh.ElementCount(), budget.elements, 0.2 * budget.elements);
    EXPECT_EQ(report.quality.inverted, 0);
    EXPECT_GE(report.quality.worst_jacobian, kLeastJacobian);
    EXPECT_LT(report.volume_error, 0.03);
  }
  EXPECT_GT(BudgetOf(MeshSize::kCoarse).error, BudgetOf(MeshSize::kFine).error);
  EXPECT_LT(BudgetOf(MeshSize::kCoarse).step_ms, BudgetOf(MeshSize::kFine).step_ms);
}

// Nodes per volume on the free half against the held half.
TEST(MeshBudget, IsFinerWhereTheTissueIsFree) {
  const SurfaceMesh torus = Torus(0.015, 0.004, 60, 24);
  const auto free_share = [&](const std::vector<Ball>& fixed) {
    const TetMesh mesh = Fill(torus, MeshSize::kDefault, fixed);
    int far = 0;
    for (const glm::dvec3& x : mesh.rest_positions) far += x.x < 0 ? 1 : 0;
    return static_cast<double>(far) / static_cast<double>(mesh.rest_positions.size());
  };
  const double even = free_share({}), graded = free_share({{{0.015, 0, 0}, 0.006}});
  std::printf("nodes on the free half: %.2f graded, %.2f not\n", graded, even);
  EXPECT_NEAR(even, 0.5, 0.06);
  EXPECT_GT(graded, 0.6);
}

TEST(MeshBudget, PulledMiddlesKeepTheVolumeThatStraightEdgesLose) {
  const SurfaceMesh fine = Sphere({0, 0, 0}, 0.01, 4);
  SurfaceMesh coarse = fine;
  SimplifyEvenly(coarse, 120, [](const glm::dvec3&) { return 1.0; });
  TetrahedralizeOptions options;
  options.order = 2;
  options.keep_surface = true;
  TetMesh mesh = Tetrahedralize(coarse, {}, options, nullptr, {}, ARTHRO_PROGRAM);
  const double truth = 4.0 / 3.0 * M_PI * 1e-6;
  const double straight = MeasureTets(mesh).curved_volume;
  const PulledMiddles pulled = PullMiddles(mesh, fine);
  const TetQuality quality = MeasureTets(mesh);
  std::printf(
      "volume of a ball: straight %.2f %% off, pulled %.3f %% off; %d pulled, %d held back\n",
      100 * (straight / truth - 1), 100 * (quality.curved_volume / truth - 1), pulled.pulled,
      pulled.held_back);
  EXPECT_LT(straight, 0.97 * truth);
  EXPECT_NEAR(quality.curved_volume, truth, 0.01 * truth);
  EXPECT_GE(quality.worst_jacobian, kLeastJacobian);
}

TEST(MeshBudget, SameInputGivesTheSameMesh) {
  const SurfaceMesh torus = Torus(0.015, 0.004, 60, 24);
  const TetMesh a = Fill(torus, MeshSize::kCoarse, {}), b = Fill(torus, MeshSize::kCoarse, {});
  EXPECT_EQ(a.elements, b.elements);
  EXPECT_EQ(a.rest_positions, b.rest_positions);
}

TEST(MeshBudget, ASurfaceOfFewTrianglesIsFilledUnchanged) {
  const TetMesh mesh = Fill(test::Box({0, 0, 0}, {0.01, 0.02, 0.01}), MeshSize::kDefault, {});
  EXPECT_GT(mesh.ElementCount(), 0);
  EXPECT_EQ(mesh.order, 2);
}

TEST(MeshBudget, AnOpenSurfaceIsRefusedWithItsPlace) {
  SurfaceMesh open = Sphere({0, 0, 0}, 0.01, 3);
  open.triangles.pop_back();
  try {
    Fill(open, MeshSize::kDefault, {});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Code::kBadMesh);
    EXPECT_NE(error.sentence().find("open"), std::string::npos) << error.sentence();
  }
}

}  // namespace
}  // namespace arthro::authoring

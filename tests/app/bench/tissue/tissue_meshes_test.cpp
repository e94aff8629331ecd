// Claims about the bodies on which tissue is measured: they are the reference's own meshes, node by
// node, so that a solver's error on them can be told from the mesh's.
#include "tests/support/tissue/tissue_meshes.h"

#include <algorithm>
#include <numbers>
#include <string>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include "simulation/core/error.h"
#include "simulation/scene/mesh/mesh_io.h"
#include "simulation/scene/mesh/tet_check.h"
#include "tests/support/shared_data.h"

namespace arthro::test {
namespace {

void ExpectSame(const TetMesh& ours, const std::filesystem::path& file) {
  SCOPED_TRACE(file);
  const TetMesh theirs = ReadTetMesh(file);
  ASSERT_EQ(ours.order, theirs.order);
  EXPECT_EQ(ours.elements, theirs.elements);
  EXPECT_EQ(ours.sets, theirs.sets);
  ASSERT_EQ(ours.rest_positions.size(), theirs.rest_positions.size());
  double worst = 0;
  for (std::size_t i = 0; i < ours.rest_positions.size(); ++i)
    worst = std::max(worst, glm::distance(ours.rest_positions[i], theirs.rest_positions[i]));
  // The files have about nine digits of numbers up to 0.1 m.
  EXPECT_LT(worst, 1e-10) << "m";
}

double CornerVolume(const TetMesh& mesh) {
  double volume = 0;
  for (int e = 0; e < mesh.ElementCount(); ++e) {
    const int* node = &mesh.elements[static_cast<std::size_t>(e * mesh.NodesPerElement())];
    const auto x = [&](int i) { return mesh.rest_positions[static_cast<std::size_t>(node[i])]; };
    volume += glm::determinant(glm::dmat3(x(1) - x(0), x(2) - x(0), x(3) - x(0))) / 6;
  }
  return volume;
}

int Count(const TetMesh& mesh, const std::string& set) {
  return static_cast<int>(std::ranges::count(mesh.sets.at(set), 1));
}

TEST(TissueMeshes, AreTheReferenceMeshes) {
  ARTHRO_REQUIRE_SHARED(folder, "reference/tissue");
  ExpectSame(BeamMesh(1, {20, 2, 2}), folder / "beam_tip_T4_S.vtu");
  ExpectSame(BeamMesh(1, {40, 4, 4}), folder / "beam_gravity_T4_M.vtu");
  ExpectSame(BeamMesh(2, {20, 2, 2}), folder / "beam_tip_T10_S.vtu");
  ExpectSame(CookMesh(1, {8, 8, 2}), folder / "cook_T4_S.vtu");
  ExpectSame(CookMesh(1, {16, 16, 4}), folder / "cook49_T4_M.vtu");
  ExpectSame(CookMesh(2, {8, 8, 2}), folder / "cook49_T10_S.vtu");
  ExpectSame(BlockMesh(1, {4, 4, 4}), folder / "block49_T4_S.vtu");
  ExpectSame(BlockMesh(1, {8, 8, 8}), folder / "block49_T4_M.vtu");
  ExpectSame(BlockMesh(2, {4, 4, 4}), folder / "block499_T10_S.vtu");
  for (const char* load : {"load", "indent"}) {
    const std::string name = std::string("meniscus_") + load;
    ExpectSame(MeniscusMesh(1, MeniscusTicks({24, 4, 2})), folder / (name + "_T4_S.vtu"));
    ExpectSame(MeniscusMesh(1, MeniscusTicks({48, 8, 4})), folder / (name + "_T4_M.vtu"));
    ExpectSame(MeniscusMesh(2, MeniscusTicks({24, 4, 2})), folder / (name + "_T10_S.vtu"));
  }
}

TEST(TissueMeshes, FillTheBodyTheyStandFor) {
  EXPECT_NEAR(CornerVolume(BeamMesh(2, {5, 1, 2})), 1e-5, 1e-18);
  EXPECT_NEAR(CornerVolume(BlockMesh(1, {3, 1, 2})), 1e-6, 1e-19);
  EXPECT_NEAR(CornerVolume(CookMesh(1, {4, 3, 1})), 48e-3 * 30e-3 * 10e-3, 1e-18);
  // ∫ h(r) r dr over 200°, h = 1.5 mm + 0.45 (r − 10 mm): 600 mm³ a radian. Straight edges cut
  // corners: a share of (cell angle)² / 6 is missing, 8.8e-4 at 4.17°.
  const double exact = 600e-9 * 200 * std::numbers::pi / 180;
  const double angle = 200.0 / 48 * std::numbers::pi / 180;
  const double volume = CornerVolume(MeniscusMesh(1, MeniscusTicks({48, 8, 4})));
  EXPECT_NEAR(volume / exact, 1 - angle * angle / 6, 1e-5);
}

TEST(TissueMeshes, AGradedMeniscusKeepsThePatchAndItsElementsPositive) {
  const TetMesh mesh =
      MeniscusMesh(2, MeniscusTicks({0, kPatchDegrees, 20, 50, 100}, {10, 12.5, 13.5, 15, 16, 20},
                                    {0, 0.6, 0.9, 1}));
  EXPECT_EQ(mesh.ElementCount(), 6 * 8 * 5 * 3);
  EXPECT_EQ(Count(mesh, "patch"), 5 * 5);  // two by two cells with their middles
  EXPECT_EQ(Count(mesh, "inner"), 1);
  EXPECT_EQ(Count(mesh, "horns"), 2 * 11 * 7);
  for (int e = 0; e < mesh.ElementCount(); ++e) EXPECT_GT(RelativeVolume(mesh, e), 1e-4) << e;
  // Middle nodes of the outer wall lie on the circle, not on its chords.
  for (const glm::dvec3& x : mesh.rest_positions)
    EXPECT_LE(glm::length(glm::dvec2(x)), kMeniscusOuter + 1e-12);
  EXPECT_THROW(MeniscusMesh(2, MeniscusTicks({0, 100}, {10, 20}, {0, 0, 1})), Error);
}

}  // namespace
}  // namespace arthro::test

// Tissues in the window: placed, meshed, given a material, held, cut and poked.
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/scene/files/scene_io.h"
#include "tests/app/editor/editor_window.h"

namespace arthro {
namespace {

using test::EditorWindow;

TEST_F(EditorWindow, TissueIsTypedIntoPlaceAndFilledWithTetrahedra) {
  Drive(R"(
click Tissue
set "Position (right, down, in), in" 25
expect value "Position (right, down, in), in" "25.0 mm"
click Mesh
expect "no tetrahedra yet"
expect "About 300 elements"
click "Mesh size"
click coarse
expect "About 150 elements"
click "Make tetrahedra"
wait job
expect "filled with tetrahedra"
click Save
wait job
expect "Saved in"
)");
  const Scene saved = ReadScene(scene);
  EXPECT_NEAR(saved.tissues.at(0).pose.position.z, 0.025, 1e-12);
  const TetMesh mesh = ReadTetMesh(scene / saved.tissues.at(0).mesh);
  EXPECT_GT(mesh.ElementCount(), 0);
  EXPECT_EQ(mesh.order, 2);
}

// The panorama was moved by the drag.
TEST_F(EditorWindow, ADragOverThePanoramaLaysTheTissueThere) {
  const glm::dvec3 before = ReadScene(scene).tissues.at(0).pose.position;
  Drive(R"(
click Tissue
do lay-on-relief
wait frames 3
click "Show the panorama"
wait frames 3
drag "Panorama picture" 30 10
expect Undo
click Save
wait job
expect "Saved in"
)");
  const glm::dvec3 laid = ReadScene(scene).tissues.at(0).pose.position;
  EXPECT_GT(glm::distance(laid, before), 1e-3);
}

TEST_F(EditorWindow, MaterialIsChosenWithItsSourcesAndItsStiffnessTyped) {
  Drive(R"(
click Tissue
click Material
expect value Preset "Meniscus, for probing"
expect value "Stiffness" "0.5 MPa"
click Sources
expect "Danso 2018"
click Sources
set "Stiffness" 0.3
expect value "Stiffness" "0.3 MPa"
expect "Differs from the preset."
click "Instruments may cut it"
click Preset
click "Cartilage, for probing"
expect "Thickness of the layer"
expect not "Differs from the preset."
click Undo
expect value "Stiffness" "0.3 MPa"
click Save
wait job
expect "Saved in"
)");
  const Scene saved = ReadScene(scene);
  EXPECT_EQ(saved.tissues.at(0).material, "meniscus");
  EXPECT_NEAR(saved.tissues.at(0).elasticity.young_modulus.value_or(0), 3e5, 1e-3);
  EXPECT_FALSE(saved.tissues.at(0).elasticity.poisson_ratio);
  EXPECT_FALSE(saved.tissues.at(0).is_cuttable);
}

TEST_F(EditorWindow, AClickInTheOverviewSaysWhereTheTissueIsProbed) {
  Drive(R"(
click Tissue
set "Position (right, down, in), down" 3
set "Position (right, down, in), in" 22.5
click Mesh
expect "Finer where it is free"
set "Radius of the next ball" 1.5
click "Finer here…"
wait frames 3
click Overview
wait frames 3
expect "Finest in 1 probed place:"
expect value "Ball 1" on
click Hold
expect "Nothing holds this tissue"
click Mesh
click "Make tetrahedra"
wait job
expect "curved tetrahedra"
click Save
wait job
expect "Saved in"
)");
  const Scene saved = ReadScene(scene);
  EXPECT_TRUE(saved.tissues.at(0).fixed.empty());
  ASSERT_EQ(saved.tissues.at(0).probed.size(), 1u);
  EXPECT_NEAR(saved.tissues[0].probed[0].radius, 0.0015, 1e-9);
}

TEST_F(EditorWindow, AMeniscusOfTheLibraryIsAddedByAClickTornAndSaved) {
  Drive(R"(
click Tissue
click Library
wait frames 20
click "Medial meniscus"
wait job
expect "lies on the relief"
click Cut
click "Tears of a meniscus"
wait frames 3
click "Make this tear"
expect "Longitudinal tear of"
click Undo
click Redo
click Save
wait job
expect "Saved in"
)");
  const Scene saved = ReadScene(scene);
  const Tissue& meniscus = saved.tissues.back();
  EXPECT_TRUE(meniscus.name.starts_with("medial meniscus")) << meniscus.name;
  EXPECT_FALSE(meniscus.mesh.empty());
  EXPECT_EQ(meniscus.cuts.size(), 1u);
  EXPECT_EQ(meniscus.regions.size(), 3u);
}

TEST_F(EditorWindow, ATissueIsMadeASolidThatDoesNotGiveWayAndThatIsUndone) {
  Drive(R"(
click Tissue
click Mesh
expect "no tetrahedra yet"
click "A solid that does not give way"
expect "a solid"
expect not "no tetrahedra yet"
click Undo
expect "no tetrahedra yet"
click Redo
expect "a solid"
click Save
wait job
expect "Saved in"
)");
  EXPECT_TRUE(ReadScene(scene).tissues.at(0).is_implicit);
}

TEST_F(EditorWindow, AClickInTheOverviewHoldsTheTissueThereAndIsUndone) {
  Drive(R"(
click Tissue
set "Position (right, down, in), down" 3
set "Position (right, down, in), in" 22.5
click Hold
expect "Nothing holds this tissue"
click "Hold it here…"
wait frames 3
click Overview
wait frames 3
expect "1 ball hold"
expect value "Ball 1" on
set "Radius of this ball" 3
click "Hold it at the instrument"
expect "2 balls hold it."
click Undo
expect "1 ball hold"
click Save
wait job
expect "Saved in"
)");
  const Scene saved = ReadScene(scene);
  ASSERT_EQ(saved.tissues.at(0).fixed.size(), 1u);
  const Ball& ball = saved.tissues[0].fixed[0];
  EXPECT_NEAR(ball.radius, 0.003, 1e-9);
  // On the octahedron of 6 mm: |x| + |y| + |z| is its radius all over its surface.
  EXPECT_NEAR(std::abs(ball.centre.x) + std::abs(ball.centre.y) + std::abs(ball.centre.z), 0.006,
              1e-6);
}

TEST_F(EditorWindow, AClickInTheScopesPictureHoldsTheTissueAndAMissIsToldAndEscLeaves) {
  Drive(R"(
click Portals
click "0°"
click Tissue
set "Position (right, down, in), down" 0
set "Position (right, down, in), in" 26
click Hold
click "Hold it here…"
wait frames 3
click Picture 0 -190
wait frames 3
expect "1 ball hold"
click Picture
wait frames 3
expect "There is no tissue at that place"
expect "1 ball hold"
key escape
wait frames 3
expect "The overview turns and moves again."
click Picture 0 -190
wait frames 3
expect "1 ball hold"
)");
}

TEST_F(EditorWindow, ATearABiteAndARegionAreClickedInTheOverviewAndPractised) {
  Drive(R"(
click Tissue
set "Position (right, down, in), down" 3
set "Position (right, down, in), in" 22.5
click Cut
expect "Make them on the Mesh page first"
click Mesh
click "Make tetrahedra"
wait job
click Hold
set "Radius of the next ball" 6
click "Hold it here…"
click Overview
expect "1 ball hold"
click Cut
expect "Whole. A trainee begins with what you cut here."
wheel Overview 3
click "Tear…"
click Overview -8 0
expect "Now click where the tear goes on."
expect disabled Redo
click Overview 0 2
expect "Tear octahedron"
expect value "Tear 1" on
click Overview 8 0
expect "Lengthen a tear of octahedron"
click Undo
expect value "Tear 1" on
key ctrl+y
set "Tear depth" 3
expect value "Tear depth" "3.0 mm"
click "Bite…"
click Overview 0 8
expect value "Bite 2" on
set "Bite radius" 1.2
click "Remove this cut"
expect not "Bite 2"
click Undo
expect value "Bite 2" off
click "Region…"
click Overview -4 0
click "Region name"
key ctrl+a
type horn
key enter
expect value horn on
set "Region radius" 4
click Save
wait job
expect "Saved in"
click Practise
wait job
wait frames 10
expect "0.0 mm³ removed"
)");
  const Tissue saved = ReadScene(scene).tissues.at(0);
  ASSERT_EQ(saved.cuts.size(), 2u);
  const auto& tear = std::get<TearCut>(saved.cuts[0]);
  EXPECT_EQ(tear.path.size(), 3u);
  EXPECT_NEAR(tear.depth, 0.003, 1e-9);
  for (const glm::dvec3& x : tear.path)  // on the octahedron of 6 mm
    EXPECT_LT(std::abs(x.x) + std::abs(x.y) + std::abs(x.z), 0.006 + 1e-6);
  EXPECT_NEAR(std::get<CapsuleCut>(saved.cuts[1]).radius, 0.0012, 1e-9);
  ASSERT_EQ(saved.regions.size(), 1u);
  EXPECT_EQ(saved.regions[0].name, "horn");
  EXPECT_NEAR(saved.regions[0].ball.radius, 0.004, 1e-9);
}

TEST_F(EditorWindow, TheAuthorPokesInTheirOwnViewAndAnEditEndsIt) {
  Drive(R"(
click Tissue
click "Poke it"
wait job
wait frames 5
expect "instruments cause harm above 8.5 N"
expect value "Poke it" on
drag Picture 20 0 right
wait frames 5
set "Position (right, down, in), in" 25
wait frames 3
expect not "instruments cause harm above 8.5 N"
)");
}

}  // namespace
}  // namespace arthro

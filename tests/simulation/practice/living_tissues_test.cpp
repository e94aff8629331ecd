#include "simulation/practice/living_tissues.h"

#include <gtest/gtest.h>

#include "simulation/core/error.h"
#include "simulation/scene/mesh/mesh_io.h"
#include "tests/support/temp_folder.h"

namespace arthro::simulation {
namespace {

// Tissue placed at twice its size: quantities in its own frame scale with it.
TEST(LivingTissues, ScalesFixedPlacesCutsAndRegionsByThePose) {
  test::TempFolder folder;
  const SurfaceMesh surface = {{{0, 0, 0}, {0.01, 0, 0}, {0, 0.01, 0}, {0, 0, 0.01}},
                               {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  TetMesh mesh;
  mesh.rest_positions = surface.vertices;
  mesh.elements = {0, 1, 2, 3};
  WriteTetMesh(folder / "m.vtu", mesh);
  LoadedScene loaded;
  loaded.folder = folder.path();
  loaded.surfaces = {Share(surface)};
  Tissue& tissue = loaded.scene.tissues.emplace_back();
  tissue.name = "meniscus";
  tissue.mesh = "m.vtu";
  tissue.material = "soft";
  tissue.pose.scale = 2;
  tissue.fixed = {{{0.001, 0, 0}, 0.002}};
  tissue.cuts = {TearCut{{{0.001, 0, 0}, {0, 0.001, 0}}, {0, 0, -1}, 1e-3, 5e-4, 2e-4},
                 CapsuleCut{{0.001, 0, 0}, {0, 0.001, 0}, 3e-4},
                 BoxCut{{{1, 0, 0, 0}, {0.001, 0, 0}}, {1e-3, 2e-3, 3e-3}}};
  tissue.regions = {{"horn", {{0, 0.001, 0}, 0.004}}};
  TissuePreset preset;
  preset.name = "soft";
  const std::vector<BodySpec> bodies = LivingTissues(loaded, {preset});
  ASSERT_EQ(bodies.size(), 1u);
  const BodySpec& body = bodies[0];
  EXPECT_EQ(body.mesh.rest_positions[1], glm::dvec3(0.02, 0, 0));
  EXPECT_EQ(body.fixed, (std::vector<Ball>{{{0.002, 0, 0}, 0.004}}));
  EXPECT_EQ(body.cuts,
            (std::vector<Cut>{TearCut{{{0.002, 0, 0}, {0, 0.002, 0}}, {0, 0, -1}, 2e-3, 1e-3, 4e-4},
                              CapsuleCut{{0.002, 0, 0}, {0, 0.002, 0}, 6e-4},
                              BoxCut{{{1, 0, 0, 0}, {0.002, 0, 0}}, {2e-3, 4e-3, 6e-3}}}));
  EXPECT_EQ(body.regions, (std::vector<Region>{{"horn", {{0, 0.002, 0}, 0.008}}}));
}

// Message for a tetrahedron of 17.3 mm as surface, filled with itself after scaling and shifting.
std::string SaidOf(double scale, const glm::dvec3& shift) {
  test::TempFolder folder;
  const SurfaceMesh surface = {{{0, 0, 0}, {0.01, 0, 0}, {0, 0.01, 0}, {0, 0, 0.01}},
                               {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  TetMesh mesh;
  for (const glm::dvec3& x : surface.vertices) mesh.rest_positions.push_back(scale * x + shift);
  mesh.elements = {0, 1, 2, 3};
  WriteTetMesh(folder / "m.vtu", mesh);
  LoadedScene loaded;
  loaded.folder = folder.path();
  loaded.surfaces = {Share(surface)};
  Tissue& tissue = loaded.scene.tissues.emplace_back();
  tissue.name = "meniscus";
  tissue.mesh = "m.vtu";
  tissue.material = "soft";
  TissuePreset preset;
  preset.name = "soft";
  try {
    LivingTissues(loaded, {preset});
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Code::kBadMesh);
    return error.sentence();
  }
  return "nothing";
}

// A coarse mesh may differ from its surface by less than a fifth of the diagonal, 3.46 mm.
TEST(LivingTissues, RefusesAMeshThatDoesNotFillItsSurface) {
  EXPECT_EQ(SaidOf(1.0, {}), "nothing");
  EXPECT_EQ(SaidOf(1.0, {0.0034, 0, 0}), "nothing");
  EXPECT_EQ(SaidOf(0.81, {}), "nothing");
  EXPECT_NE(SaidOf(1.0, {0.0035, 0, 0}).find("lie up to 3.5 mm apart"), std::string::npos);
  EXPECT_NE(SaidOf(0.79, {}).find("fill this surface again"), std::string::npos);
  EXPECT_NE(SaidOf(1e3, {}).find("meniscus: its tetrahedra and its surface of 17.3 mm"),
            std::string::npos)
      << "millimetres for metres";
}

}  // namespace
}  // namespace arthro::simulation

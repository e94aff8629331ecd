#include "simulation/scene/files/scene_check.h"

#include <limits>

#include <gtest/gtest.h>

#include "simulation/scene/files/check_report.h"
#include "simulation/scene/image_io.h"
#include "simulation/scene/mesh/held_nodes.h"
#include "simulation/scene/mesh/mesh_io.h"
#include "tests/support/schema_fault.h"
#include "tests/support/shapes.h"
#include "tests/support/temp_folder.h"

namespace arthro {
namespace {

// A tetrahedron of 10 mm with its mid-edge nodes.
TetMesh OneTet() {
  TetMesh mesh;
  mesh.order = 2;
  const glm::dvec3 corner[4] = {{0, 0, 0}, {0.01, 0, 0}, {0, 0.01, 0}, {0, 0, 0.01}};
  for (const glm::dvec3& x : corner) mesh.rest_positions.push_back(x);
  for (const auto& [a, b] : {std::pair{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}})
    mesh.rest_positions.push_back((corner[a] + corner[b]) * 0.5);
  for (int i = 0; i < 10; ++i) mesh.elements.push_back(i);
  return mesh;
}

SceneFindings FindingsWith(const std::vector<Ball>& fixed, const std::vector<Ball>& probed = {}) {
  test::TempFolder folder;
  Scene scene;
  scene.backdrop.panorama = "p.png";
  scene.backdrop.projection = {ProjectionType::kGnomonic, {7.5, 3.5}, 9.0, 10.0};
  Tissue& tissue = scene.tissues.emplace_back();
  tissue.name = "flap";
  tissue.surface = "flap.ply";
  tissue.mesh = "flap.vtu";
  tissue.fixed = fixed;
  tissue.probed = probed;
  WriteColourImage(folder / "p.png", ColourImage(16, 8));
  WriteSurface(folder / "flap.ply", {{{0, 0, 0}, {0.01, 0, 0}, {0, 0.01, 0}}, {{0, 1, 2}}});
  WriteTetMesh(folder / "flap.vtu", OneTet());
  WriteScene(folder / "scene.json", scene);
  SceneFindings findings = CheckScene(folder.path());
  EXPECT_TRUE(findings.errors.empty());
  return findings;
}

bool Says(const std::vector<std::string>& lines, const std::string& part) {
  for (const std::string& line : lines)
    if (line.find(part) != std::string::npos) return true;
  return false;
}

TEST(HeldNodes, AreThoseInsideAnyBallAndOnItsBoundary) {
  const std::vector<glm::dvec3> nodes = {{0, 0, 0}, {0.001, 0, 0}, {0.0011, 0, 0}, {0.01, 0, 0}};
  const std::vector<Ball> balls = {{{0, 0, 0}, 0.001}, {{0.01, 0, 0}, 1e-6}};
  EXPECT_EQ(HeldNodes(nodes, balls), (std::vector<std::uint8_t>{1, 1, 0, 1}));
  EXPECT_EQ(HeldNodes(nodes, {}), (std::vector<std::uint8_t>{0, 0, 0, 0}));
}

TEST(SceneCheck, WarnsOfATissueThatNothingHolds) {
  EXPECT_TRUE(Says(FindingsWith({}).warnings, "is held nowhere"));
  EXPECT_TRUE(Says(FindingsWith({{{1, 1, 1}, 0.001}}).warnings, "nothing holds it: it will drift"));
}

TEST(SceneCheck, WarnsOfPinsThatHoldTooLittleOrAll) {
  EXPECT_TRUE(Says(FindingsWith({{{0, 0, 0}, 0.001}}).warnings, "held at 1 of its nodes only"));
  EXPECT_TRUE(Says(FindingsWith({{{0, 0, 0}, 0.1}}).warnings, "does not deform"));
}

TEST(SceneCheck, CountsWhatTheBallsHoldAndNamesAnIdleOne) {
  // The corner at the origin and the three middles of its edges lie within 5 mm of it.
  const SceneFindings findings = FindingsWith({{{0, 0, 0}, 0.0051}, {{0.5, 0, 0}, 0.001}});
  EXPECT_TRUE(Says(findings.found, "\"flap\": held at 4 of 10 nodes, 2 balls"));
  EXPECT_FALSE(Says(findings.warnings, "held"));
  EXPECT_TRUE(Says(findings.hints, "ball 2 of \"fixed\" holds no node"));
}

TEST(SceneCheck, NamesAProbedPlaceThatTheMeshWasNotMadeFor) {
  const std::vector<Ball> held = {{{0, 0, 0}, 0.0051}};
  const SceneFindings findings =
      FindingsWith(held, {{{0.01, 0, 0}, 0.001}, {{0.5, 0, 0}, 0.001}, {{0.005, 0.005, 0}, 1e-6}});
  EXPECT_FALSE(Says(findings.warnings, "ball 1 of \"probed\""));
  EXPECT_TRUE(Says(findings.warnings, "ball 2 of \"probed\" has no node"));
  EXPECT_FALSE(Says(findings.warnings, "ball 3 of \"probed\""));
}

LoadedScene WithOne(const SurfaceMesh& surface) {
  LoadedScene loaded;
  loaded.scene.tissues.emplace_back().name = "flap";
  loaded.surfaces.push_back(Share(surface));
  return loaded;
}

TEST(SceneCheck, ATissueWithoutTetrahedraThatIsAThinLayerDeforms) {
  const LoadedScene loaded = WithOne(test::Box({0, 0, 0.02}, {0.01, 0.01, 0.03}));
  EXPECT_TRUE(Says(CheckScene(loaded).hints, "does not deform"));
  const SceneFindings layer = CheckScene(loaded, [](const Tissue&) { return true; });
  EXPECT_FALSE(Says(layer.hints, "does not deform"));
  EXPECT_TRUE(Says(layer.found, "\"flap\": gives way as a thin layer"));
}

TEST(SceneCheck, ASolidThatDoesNotGiveWayNeedsAClosedSurfaceAndNoTetrahedra) {
  LoadedScene loaded = WithOne(test::Box({0, 0, 0.02}, {0.01, 0.01, 0.03}));
  loaded.scene.tissues[0].is_implicit = true;
  const SceneFindings good = CheckScene(loaded);
  EXPECT_TRUE(good.errors.empty());
  EXPECT_FALSE(Says(good.hints, "does not deform"));
  EXPECT_TRUE(Says(good.found, "\"flap\": a solid that does not give way"));
  SurfaceMesh open = *loaded.surfaces[0];
  open.triangles.pop_back();
  loaded.surfaces[0] = Share(std::move(open));
  EXPECT_TRUE(Says(CheckScene(loaded).errors, "is not closed: 3 edges"));
  loaded.scene.tissues[0].mesh = "flap.vtu";
  EXPECT_TRUE(Says(CheckScene(loaded).errors, "has tetrahedra; leave out one of the two"));
}

TEST(SceneCheck, SaysWhatShareOfTheReliefIsMeasuredAndItsError) {
  LoadedScene loaded;
  DepthMap depth(10, 10, 0.01f), sigma(10, 10, 4e-4f);
  OriginMap origins(10, 10, ReliefOrigin::kMeasured);
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  for (int x = 0; x < 10; ++x) {
    depth.at(x, 0) = sigma.at(x, 0) = kNan;
    origins.at(x, 0) = ReliefOrigin::kNone;
    origins.at(x, 1) = ReliefOrigin::kBrightness;
    origins.at(x, 2) = ReliefOrigin::kInterpolated;
    sigma.at(x, 2) = 3e-3f;
  }
  loaded.depth = Share(depth);
  EXPECT_FALSE(Says(CheckScene(loaded).found, "relief:")) << "nothing is known";
  EXPECT_FALSE(CheckScene(loaded).relief);
  loaded.depth_sigma = Share(sigma);
  EXPECT_TRUE(Says(CheckScene(loaded).found, "relief: median standard error 0.4 mm"));
  loaded.depth_origin = Share(origins);
  const SceneFindings findings = CheckScene(loaded);
  EXPECT_TRUE(Says(findings.found,
                   "relief: 77.8 % measured, 11.1 % from brightness, 11.1 % interpolated, median "
                   "standard error 0.4 mm"));
  ASSERT_TRUE(findings.relief);
  EXPECT_DOUBLE_EQ(findings.relief->measured, 70.0 / 90);
  EXPECT_FALSE(Says(findings.warnings, "of the depths"));
}

TEST(SceneCheck, ItsReportKeepsItsSchema) {
  LoadedScene loaded;
  EXPECT_EQ(test::SchemaFault("check-1", JsonFromFindings(CheckScene(loaded))), "");
  loaded.depth = Share(DepthMap(10, 10, 0.01f));
  loaded.depth_sigma = Share(DepthMap(10, 10, 4e-4f));
  loaded.depth_origin = Share(OriginMap(10, 10, ReliefOrigin::kMeasured));
  SceneFindings findings = CheckScene(loaded);
  findings.errors = {"a file is missing"};
  const std::string report = JsonFromFindings(findings);
  EXPECT_EQ(test::SchemaFault("check-1", report), "");
  EXPECT_NE(report.find("\"measured\": 1.0"), std::string::npos) << report;
  EXPECT_NE(report.find("\"median_sigma\""), std::string::npos);
  EXPECT_EQ(test::SchemaFault("check-1", "{\"schema\": \"arthroscene.check/1\"}"), "# required");
}

TEST(SceneCheck, SaysThatADepthMapIsMostlyNoise) {
  LoadedScene loaded;
  DepthMap depth(10, 10, 0.01f);
  depth.at(3, 3) = 0.013f;
  loaded.depth = Share(depth);
  loaded.depth_sigma = Share(DepthMap(10, 10, 4e-4f));
  EXPECT_FALSE(Says(CheckScene(loaded).warnings, "mostly noise")) << "3 mm are 7.5 errors";
  loaded.depth_sigma = Share(DepthMap(10, 10, 6e-4f));
  EXPECT_TRUE(Says(CheckScene(loaded).warnings,
                   "its noise is 0.6 mm, and its depths span 3 mm; outlines are not drawn"));
}

TEST(SceneCheck, HintsAtErrorsOfNought) {
  LoadedScene loaded;
  DepthMap depth(10, 10, 0.01f);
  depth.at(3, 3) = 0.013f;
  loaded.depth = Share(depth);
  loaded.scene.backdrop.depth_sigma = "depth-sigma.tiff";
  loaded.depth_sigma = Share(DepthMap(10, 10, 4e-4f));
  EXPECT_FALSE(Says(CheckScene(loaded).hints, "most depths are exact"));
  loaded.depth_sigma = Share(DepthMap(10, 10, 0.0f));
  EXPECT_TRUE(Says(CheckScene(loaded).hints, "most depths are exact"));
}

TEST(SceneCheck, WarnsOfDepthsWithoutOriginOrError) {
  LoadedScene loaded;
  DepthMap sigma(10, 10, 4e-4f);
  OriginMap origins(10, 10, ReliefOrigin::kMeasured);
  for (int x = 0; x < 10; ++x) {
    origins.at(x, 3) = ReliefOrigin::kNone;
    sigma.at(x, 4) = sigma.at(x, 5) = std::numeric_limits<float>::quiet_NaN();
  }
  loaded.depth = Share(DepthMap(10, 10, 0.01f));
  loaded.depth_sigma = Share(sigma);
  loaded.depth_origin = Share(origins);
  const SceneFindings findings = CheckScene(loaded);
  EXPECT_TRUE(Says(findings.warnings, "10.0 % of the depths have no origin"));
  EXPECT_TRUE(Says(findings.warnings, "20.0 % of the depths have no standard error"));
}

}  // namespace
}  // namespace arthro

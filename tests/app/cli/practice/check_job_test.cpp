#include <limits>

#include <gtest/gtest.h>

#include "simulation/core/atomic_file.h"
#include "simulation/scene/files/scene_io.h"
#include "simulation/scene/image_io.h"
#include "simulation/scene/json/lens_io.h"
#include "simulation/scene/mesh/mesh_io.h"
#include "tests/support/build_paths.h"
#include "tests/support/run_program.h"
#include "tests/support/schema_fault.h"

namespace arthro {
namespace {

namespace fs = std::filesystem;

SurfaceMesh Tetrahedron(double size, const glm::dvec3& corner) {
  return {{corner, corner + glm::dvec3(size, 0, 0), corner + glm::dvec3(0, size, 0),
           corner + glm::dvec3(0, 0, size)},
          {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

// A scene with nothing to complain about, in `folder`.
Scene WriteGoodScene(const fs::path& folder) {
  const AssetRights rights{"made in code", "CC0-1.0", "none needed: synthetic"};
  Scene scene;
  scene.title = "Good";
  scene.author = "A";
  scene.backdrop.panorama = "p.png";
  scene.backdrop.depth = "d.tiff";
  scene.backdrop.rights = rights;
  scene.backdrop.depth_rights = scene.backdrop.rights;
  scene.backdrop.projection = {ProjectionType::kGnomonic, {31.5, 15.5}, 30, 10};
  Tissue tissue;
  tissue.name = "meniscus";
  tissue.surface = "m.ply";
  tissue.mesh = "m.vtu";
  tissue.fixed = {{{0.0033, 0.0033, 0.02}, 0.0076}};  // three of its four corners
  tissue.rights = rights;
  scene.tissues = {tissue};
  scene.instruments = {{"probe", "probe"}};
  scene.exercises.emplace_back().id = "look";
  WriteColourImage(folder / "p.png", ColourImage(64, 32));
  WriteDepthMap(folder / "d.tiff", DepthMap(64, 32, 0.01f));
  const SurfaceMesh surface = Tetrahedron(0.01, {0, 0, 0.02});
  WriteSurface(folder / "m.ply", surface);
  TetMesh mesh;
  mesh.rest_positions = surface.vertices;
  mesh.elements = {0, 1, 2, 3};
  WriteTetMesh(folder / "m.vtu", mesh);
  WriteScene(folder / "scene.json", scene);
  return scene;
}

TEST(CheckJob, SaysWhatAGoodSceneHolds) {
  test::TempFolder folder;
  WriteGoodScene(folder.path());
  const auto result = test::RunProgram("check " + folder.path().string());
  EXPECT_EQ(result.exit_code, 0) << result.err;
  for (const char* part :
       {"title: Good", "panorama: 64 x 32 px, gnomonic with a focal length of 30 px",
        "relief 10 to 10 mm, 100.0 % imaged", "\"meniscus\": 4 triangles, 10 x 10 x 10 mm",
        "1 tetrahedra of order 1, 4 nodes", "30 degrees oblique", "30 mm to the right"})
    EXPECT_NE(result.out.find(part), std::string::npos) << part << "\n" << result.out;
  EXPECT_EQ(result.out.find("warning"), std::string::npos) << result.out;
  EXPECT_EQ(result.err, "");
}

TEST(CheckJob, WarnsOfWhatIsDoubtfulAndHintsAtWhatIsMissing) {
  test::TempFolder folder;
  Scene scene = WriteGoodScene(folder.path());
  scene.backdrop.rights.consent.clear();
  scene.tissues[0].rights = {};
  scene.tissues[0].mesh.clear();
  scene.tissues[0].pose.position.x = 0.3;
  scene.portals.incision_spacing = -0.06;
  scene.rig.scope.rod_length = 0.04;
  scene.backdrop.projection.centre_px.x = 1000;
  scene.exercises.clear();
  WriteScene(folder / "scene.json", scene);
  DepthMap depth(64, 32, 5.0f);  // mm, by mistake
  depth.at(0, 0) = std::numeric_limits<float>::quiet_NaN();
  WriteDepthMap(folder / "d.tiff", depth);
  SurfaceMesh open = Tetrahedron(0.01, {0, 0, 0.02});
  open.triangles.pop_back();
  WriteSurface(folder / "m.ply", open);
  const auto result = test::RunProgram("check " + (folder / "scene.json").string());
  EXPECT_EQ(result.exit_code, 0) << result.err;
  for (const char* part :
       {"warning: panorama: no consent is given",
        "warning: tissue \"meniscus\": no source, licence, consent is given",
        "warning: 2047 of 2047 depths lie outside 0 to 50 mm", "warning: the instrument's portal",
        "warning: the scope's rod of 40 mm", "centre_px (1000, 15.5) lies outside the panorama",
        "never seen", "3 edges do not join two triangles", "hint: tissue \"meniscus\" has no tet",
        "hint: no exercises", "with 8 warnings"})
    EXPECT_NE(result.out.find(part), std::string::npos) << part << "\n" << result.out;
}

TEST(CheckJob, SaysThatTheLampWaitsForADepthMap) {
  test::TempFolder folder;
  Scene scene = WriteGoodScene(folder.path());
  const auto says = [&] {
    WriteScene(folder / "scene.json", scene);
    return test::RunProgram("check " + folder.path().string()).out.find("waits for a depth map") !=
           std::string::npos;
  };
  scene.backdrop.relight = 0.5;
  EXPECT_FALSE(says());
  scene.backdrop.depth.clear();
  EXPECT_TRUE(says());
  scene.backdrop.relight = 0;
  EXPECT_FALSE(says());
}

TEST(CheckJob, SaysWhatTheAuthorsCutsTakeAndWhichMiss) {
  test::TempFolder folder;
  Scene scene = WriteGoodScene(folder.path());
  Tissue& tissue = scene.tissues[0];
  const CapsuleCut bite{{0.003, 0.003, 0.02}, {0.003, 0.003, 0.02}, 0.001};
  tissue.cuts = {bite, TearCut{{{0.02, 0, 0}, {0.025, 0, 0}}}};
  tissue.regions = {{"corner", {{0, 0, 0.02}, 0.003}}, {"far", {{0.1, 0, 0}, 0.003}}};
  WriteScene(folder / "scene.json", scene);
  const auto result = test::RunProgram("check " + folder.path().string());
  EXPECT_EQ(result.exit_code, 0) << result.err;
  for (const char* part : {"tissue \"meniscus\": 2 cuts take 2.",  // half a ball of 1 mm: 2.09 mm³
                           "warning: tissue \"meniscus\": cut 2 of \"cuts\" misses it",
                           "warning: tissue \"meniscus\": region \"far\" holds nothing of it"})
    EXPECT_NE(result.out.find(part), std::string::npos) << part << "\n" << result.out;
  EXPECT_EQ(result.out.find("region \"corner\""), std::string::npos) << result.out;

  // The top of it, cut loose.
  tissue.regions.clear();
  tissue.fixed = {{{0, 0, 0.02}, 0.002}};
  tissue.cuts = {BoxCut{{{1, 0, 0, 0}, {0.003, 0.003, 0.0235}}, {0.008, 0.008, 0.0003}}};
  WriteScene(folder / "scene.json", scene);
  const auto loose = test::RunProgram("check " + folder.path().string());
  EXPECT_NE(loose.out.find("1 cut takes"), std::string::npos) << loose.out;
  const bool is_told = loose.out.find("small loose piece, washed away") != std::string::npos;
  EXPECT_TRUE(is_told) << loose.out;

  tissue.cuts = {CapsuleCut{{0, 0, 0.02}, {0, 0, 0.02}, 0.1}};
  WriteScene(folder / "scene.json", scene);
  const auto all = test::RunProgram("check " + folder.path().string());
  EXPECT_EQ(all.exit_code, 1);
  EXPECT_NE(all.err.find("tissue \"meniscus\": its cuts leave nothing of it"), std::string::npos)
      << all.err;

  tissue.cuts = {bite};
  tissue.mesh.clear();
  WriteScene(folder / "scene.json", scene);
  EXPECT_NE(test::RunProgram("check " + folder.path().string())
                .out.find("it has no tetrahedra, so its \"cuts\" and \"regions\" do nothing"),
            std::string::npos);
}

TEST(CheckJob, SaysWhatTheScopeLooksThroughAndWhichLensCannotBeDrawn) {
  test::TempFolder folder;
  Scene scene = WriteGoodScene(folder.path());
  scene.scope.lens = "lens.json";
  WriteScene(folder / "scene.json", scene);
  Lens lens;
  lens.model = LensModel::kPinhole;
  lens.width = 640, lens.height = 480;
  lens.focal_px = 300;
  lens.cx = 320, lens.cy = 240;
  lens.circle = {320, 240, 230};
  lens.field_of_view = FieldOfViewOf(lens).value();
  WriteLens(folder / "lens.json", lens);
  const auto good = test::RunProgram("check " + folder.path().string());
  EXPECT_EQ(good.exit_code, 0) << good.err;
  EXPECT_NE(good.out.find("lens: pinhole, 75.0 degrees"), std::string::npos) << good.out;
  lens.circle.r = 3300;  // 169 degrees of a pinhole
  lens.field_of_view = FieldOfViewOf(lens).value();
  WriteLens(folder / "lens.json", lens);
  const auto wide = test::RunProgram("check " + folder.path().string());
  EXPECT_EQ(wide.exit_code, 1);
  EXPECT_NE(wide.err.find("scope.lens, lens.json: the lens bends too much"), std::string::npos)
      << wide.err;
}

TEST(CheckJob, SaysWhatShareOfTheReliefIsMeasuredAlsoInItsReport) {
  test::TempFolder folder;
  Scene scene = WriteGoodScene(folder.path());
  scene.backdrop.depth_sigma = "s.tiff";
  scene.backdrop.depth_origin = "o.png";
  WriteScene(folder / "scene.json", scene);
  WriteDepthMap(folder / "s.tiff", DepthMap(64, 32, 3e-4f));
  OriginMap origins(64, 32, ReliefOrigin::kMeasured);
  for (int x = 0; x < 64; ++x)
    for (int y = 0; y < 8; ++y) origins.at(x, y) = ReliefOrigin::kBrightness;
  WriteOriginMap(folder / "o.png", origins);
  const auto result = test::RunProgram("check " + folder.path().string() + " --report " +
                                       (folder / "report.json").string());
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("relief: 75.0 % measured, 25.0 % from brightness, 0.0 % interpolated, "
                            "median standard error 0.3 mm"),
            std::string::npos)
      << result.out;
  const std::string report = ReadWholeFile(folder / "report.json");
  EXPECT_EQ(test::SchemaFault("check-1", report), "");
  EXPECT_NE(report.find("\"brightness\": 0.25"), std::string::npos) << report;
}

TEST(CheckJob, ListsEveryErrorAndExitsWithOne) {
  test::TempFolder folder;
  Scene scene = WriteGoodScene(folder.path());
  scene.tissues[0].surface = "gone.ply";
  WriteScene(folder / "scene.json", scene);
  WriteAtomically(folder / "p.png", "not a picture");
  WriteAtomically(folder / "m.vtu", "<VTKFile");
  std::string text = ReadWholeFile(folder / "scene.json");
  text.replace(text.find("\"radius\": 0.05"), 14, "\"radius\": -1");
  WriteAtomically(folder / "scene.json", text);
  const auto result = test::RunProgram("check " + folder.path().string());
  EXPECT_EQ(result.exit_code, 1);
  for (const char* part : {"backdrop.radius is -1", "p.png: this file is not a picture",
                           "tissues[0].surface names \"gone.ply\"", "m.vtu", "has 4 errors"})
    EXPECT_NE(result.err.find(part), std::string::npos) << part << "\n" << result.err;
}

TEST(CheckJob, ListsWhatIsMissingForSharing) {
  test::TempFolder folder;
  Scene scene = WriteGoodScene(folder.path());
  const std::string job = "check --for-sharing " + folder.path().string();
  const auto good = test::RunProgram(job);
  EXPECT_EQ(good.exit_code, 0) << good.err;
  EXPECT_EQ(good.out, "this scene states its title, its author and the rights in each asset\n");
  scene.author = "";
  scene.backdrop.rights.consent = "";
  scene.tissues[0].rights = {"", "", "none needed"};
  WriteScene(folder / "scene.json", scene);
  const auto poor = test::RunProgram(job);
  EXPECT_EQ(poor.exit_code, 1);
  EXPECT_EQ(poor.out, "");
  for (const char* line :
       {"missing: the scene has no author\n", "missing: the panorama has no consent\n",
        "missing: tissue \"meniscus\" has no source, licence\n", "3 things should be stated"})
    EXPECT_NE(poor.err.find(line), std::string::npos) << line << "\n" << poor.err;
}

TEST(CheckJob, FindsTheDemoReadyForSharing) {
  const auto demo = test::RunProgram("check --for-sharing " ARTHRO_SOURCE_DIR "/resources/demo");
  EXPECT_EQ(demo.exit_code, 0) << demo.err;
}

TEST(CheckJob, RefusesWhatIsNoScene) {
  test::TempFolder folder;
  WriteAtomically(folder / "scene.json", "{\"schema\": \"arthroscene.scene/9\"}");
  const auto newer = test::RunProgram("check " + folder.path().string());
  EXPECT_EQ(newer.exit_code, 1);
  EXPECT_NE(newer.err.find("arthroscene.scene/9, which is newer"), std::string::npos) << newer.err;
  EXPECT_EQ(test::RunProgram("check " + (folder / "none").string()).exit_code, 1);
  EXPECT_EQ(test::RunProgram("check").exit_code, 2);
}

}  // namespace
}  // namespace arthro

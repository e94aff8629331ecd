#include "simulation/scene/files/scene_io.h"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/scene/image_io.h"
#include "simulation/scene/mesh/mesh_io.h"
#include "tests/support/build_paths.h"
#include "tests/support/example_scene.h"
#include "tests/support/temp_folder.h"

namespace arthro {
namespace {

namespace fs = std::filesystem;

Scene SmallScene() {
  Scene scene;
  scene.title = "small";
  scene.backdrop.panorama = "p.png";
  scene.backdrop.depth = "d.tiff";
  scene.backdrop.projection = {ProjectionType::kGnomonic, {7.5, 3.5}, 9.0, 10.0};
  return scene;
}

void WriteSmallFiles(const fs::path& folder) {
  WriteColourImage(folder / "p.png", ColourImage(16, 8));
  WriteDepthMap(folder / "d.tiff", DepthMap(16, 8, 0.01f));
}

std::string FaultOfReading(const fs::path& scene) {
  try {
    ReadScene(scene);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Code::kBadScene);
    return error.what();
  }
  return "";
}

std::string FaultOfText(const std::string& text) {
  test::TempFolder folder;
  WriteAtomically(folder / "scene.json", text);
  return FaultOfReading(folder.path());
}

TEST(SceneIo, FolderAndFileNameTheSameScene) {
  test::TempFolder folder;
  WriteScene(folder / "scene.json", SmallScene());
  EXPECT_EQ(ReadScene(folder.path()).title, "small");
  EXPECT_EQ(ReadScene(folder / "scene.json").title, "small");
  EXPECT_EQ(SceneFile(folder.path()), folder / "scene.json");
}

// A stranger's folder, with a link in place of one of its files.
TEST(SceneIo, AFolderReadsNothingThroughALinkThatLeavesIt) {
  for (const char* name : {"p.png", "d.tiff", "scene.json"}) {
    test::TempFolder folder;
    const fs::path scene = folder / "scene";
    fs::create_directory(scene);
    WriteSmallFiles(scene);
    WriteScene(scene / "scene.json", SmallScene());
    fs::rename(scene / name, folder / name);
    fs::create_symlink(folder / name, scene / name);
    std::vector<std::string> faults;
    const LoadedScene loaded = LoadScene(scene, faults);
    ASSERT_EQ(faults.size(), 1u) << name;
    EXPECT_NE(faults[0].find("link to a file outside"), std::string::npos) << faults[0];
    EXPECT_FALSE(loaded.files.contains(name));
    if (std::string(name) == "scene.json") {
      EXPECT_NE(FaultOfReading(scene).find("link to a file outside"), std::string::npos);
    }
    // A link that stays inside is the author's own affair.
    fs::create_directory(scene / "kept");
    fs::remove(scene / name);
    fs::rename(folder / name, scene / "kept" / name);
    fs::create_symlink(scene / "kept" / name, scene / name);
    EXPECT_NO_THROW(LoadScene(scene)) << name;
  }
}

TEST(SceneIo, ASceneIsNotWrittenThroughALinkThatLeavesItsFolder) {
  test::TempFolder folder;
  fs::create_directory(folder / "scene");
  for (const char* target : {"there.json", "missing.json"}) {
    WriteAtomically(folder / "there.json", "mine");
    fs::remove(folder / "scene" / "scene.json");
    fs::create_symlink(folder / target, folder / "scene" / "scene.json");
    EXPECT_THROW(WriteScene(folder / "scene" / "scene.json", SmallScene()), Error) << target;
  }
  EXPECT_EQ(ReadWholeFile(folder / "there.json"), "mine");
  EXPECT_FALSE(fs::exists(folder / "missing.json"));
}

TEST(SceneIo, LoadsTheFilesItNames) {
  test::TempFolder folder;
  WriteScene(folder / "scene.json", SmallScene());
  WriteSmallFiles(folder.path());
  const LoadedScene loaded = LoadScene(folder.path());
  EXPECT_EQ(loaded.folder, folder.path());
  EXPECT_EQ(loaded.panorama->width, 16);
  EXPECT_EQ(loaded.depth->at(3, 3), 0.01f);
}

TEST(SceneIo, LoadsOneSurfaceATissueInMetres) {
  test::TempFolder folder;
  Scene scene = SmallScene();
  scene.tissues.resize(2);
  scene.tissues[0].name = "a";
  scene.tissues[0].surface = "a.ply";
  scene.tissues[1].name = "b";
  scene.tissues[1].surface = "b.ply";
  WriteScene(folder / "scene.json", scene);
  WriteSmallFiles(folder.path());
  const SurfaceMesh triangle{{{0, 0, 0}, {0.01, 0, 0}, {0, 0.01, 0}}, {{0, 1, 2}}};
  WriteSurface(folder / "b.ply", triangle);
  std::vector<std::string> faults;
  const LoadedScene half = LoadScene(folder.path(), faults);
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_NE(faults[0].find("tissues[0].surface names \"a.ply\""), std::string::npos) << faults[0];
  ASSERT_EQ(half.surfaces.size(), 2u) << "surfaces stay in step with tissues";
  EXPECT_EQ(half.surfaces[1]->vertices, triangle.vertices);
  WriteSurface(folder / "a.ply", triangle);
  EXPECT_EQ(LoadScene(folder.path()).surfaces[0]->triangles, triangle.triangles);
}

TEST(SceneIo, ASceneWithoutDepthIsABareSphere) {
  test::TempFolder folder;
  Scene scene = SmallScene();
  scene.backdrop.depth.clear();
  WriteScene(folder / "scene.json", scene);
  WriteSmallFiles(folder.path());
  EXPECT_EQ(LoadScene(folder.path()).depth, nullptr);
}

// The small scene with the standard error and the origins of its depth map.
Scene MeasuredScene() {
  Scene scene = SmallScene();
  scene.backdrop.depth_sigma = "s.tiff";
  scene.backdrop.depth_origin = "o.png";
  return scene;
}

void WriteMeasuredFiles(const fs::path& folder) {
  WriteScene(folder / "scene.json", MeasuredScene());
  WriteSmallFiles(folder);
  DepthMap sigma(16, 8, 0.0004f);
  sigma.at(2, 1) = std::numeric_limits<float>::quiet_NaN();
  WriteDepthMap(folder / "s.tiff", sigma);
  OriginMap origins(16, 8, ReliefOrigin::kMeasured);
  origins.at(2, 1) = ReliefOrigin::kInterpolated;
  WriteOriginMap(folder / "o.png", origins);
}

TEST(SceneIo, LoadsTheErrorAndTheOriginsOfADepthMap) {
  test::TempFolder folder;
  WriteMeasuredFiles(folder.path());
  const LoadedScene loaded = LoadScene(folder.path());
  ASSERT_TRUE(loaded.depth_sigma && loaded.depth_origin);
  EXPECT_EQ(loaded.depth_sigma->at(3, 3), 0.0004f);
  EXPECT_TRUE(std::isnan(loaded.depth_sigma->at(2, 1)));
  EXPECT_EQ(loaded.depth_origin->at(3, 3), ReliefOrigin::kMeasured);
  EXPECT_EQ(loaded.depth_origin->at(2, 1), ReliefOrigin::kInterpolated);
  EXPECT_EQ(loaded.files.at("s.tiff").part.lock(), loaded.depth_sigma);
  EXPECT_EQ(loaded.files.at("o.png").part.lock(), loaded.depth_origin);
}

TEST(SceneIo, AScenesDepthMapHasNeitherErrorNorOriginsUnlessTheyAreNamed) {
  test::TempFolder folder;
  WriteMeasuredFiles(folder.path());
  WriteScene(folder / "scene.json", SmallScene());
  const LoadedScene loaded = LoadScene(folder.path());
  EXPECT_FALSE(loaded.depth_sigma);
  EXPECT_FALSE(loaded.depth_origin);
  EXPECT_EQ(ReadWholeFile(folder / "scene.json").find("depth_"), std::string::npos);
}

TEST(SceneIo, RefusesAnErrorAndOriginsThatDoNotFitTheDepthMap) {
  test::TempFolder folder;
  const auto only_fault = [&]() -> std::string {
    std::vector<std::string> faults;
    LoadScene(folder.path(), faults);
    return faults.size() == 1 ? faults[0] : std::to_string(faults.size()) + " faults";
  };
  const auto expect = [&](const char* part) {
    const std::string fault = only_fault();
    EXPECT_NE(fault.find(part), std::string::npos) << fault;
    WriteMeasuredFiles(folder.path());
    EXPECT_EQ(only_fault(), "0 faults");
  };
  WriteMeasuredFiles(folder.path());
  WriteDepthMap(folder / "s.tiff", DepthMap(16, 9, 0.001f));
  expect("the standard error is 16 x 9 but the depth map is 16 x 8");
  WriteOriginMap(folder / "o.png", OriginMap(8, 8));
  expect("the map of origins is 8 x 8 but the depth map is 16 x 8");
  fs::rename(folder / "o.png", folder / "s.tiff");
  WriteOriginMap(folder / "o.png", OriginMap(16, 8));
  expect("the standard error of a depth map must be a one-channel 32-bit float TIFF");
  WriteColourImage(folder / "s.tiff", ColourImage(16, 8));
  expect("the standard error of a depth map must be a one-channel 32-bit float TIFF");
  WriteColourImage(folder / "o.png", ColourImage(16, 8));
  expect("the origins of a depth map must be a one-channel 8-bit PNG");
  fs::copy_file(folder / "d.tiff", folder / "o.png", fs::copy_options::overwrite_existing);
  expect("the origins of a depth map must be a one-channel 8-bit PNG");
  OriginMap unknown(16, 8);
  unknown.at(5, 2) = static_cast<ReliefOrigin>(4);
  WriteOriginMap(folder / "o.png", unknown);
  expect("the origin at column 5, row 2 is 4");
  for (const float bad : {-0.001f, 11.0f, std::numeric_limits<float>::infinity()}) {
    DepthMap sigma(16, 8, 0.001f);
    sigma.at(3, 4) = bad;
    WriteDepthMap(folder / "s.tiff", sigma);
    expect("the standard error at column 3, row 4");
  }
}

TEST(SceneIo, ListsEveryMissingOrUnfitFile) {
  test::TempFolder folder;
  Scene scene = SmallScene();
  scene.scope.lens = "lens.json";
  WriteScene(folder / "scene.json", scene);
  std::vector<std::string> faults;
  LoadScene(folder.path(), faults);
  ASSERT_EQ(faults.size(), 3u);
  EXPECT_NE(faults[0].find("backdrop.panorama names \"p.png\""), std::string::npos) << faults[0];
  EXPECT_NE(faults[1].find("backdrop.depth"), std::string::npos);
  EXPECT_NE(faults[2].find("scope.lens"), std::string::npos);
  try {
    LoadScene(folder.path());
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(error.sentence().find("and 2 more"), std::string::npos) << error.sentence();
  }
  WriteSmallFiles(folder.path());
  WriteAtomically(folder / "lens.json",
                  R"({"model": "equisolid", "width": 720, "height": 576, "focal_px": 330,
                      "cx": 360, "cy": 288, "circle": {"cx": 360, "cy": 288, "r": 250}})");
  faults.clear();
  EXPECT_TRUE(LoadScene(folder.path(), faults).lens) << "it is read with the scene";
  WriteDepthMap(folder / "d.tiff", DepthMap(16, 9, 0.0f));
  faults.clear();
  LoadScene(folder.path(), faults);
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_NE(faults[0].find("16 x 9"), std::string::npos) << faults[0];
}

TEST(SceneIo, SaysWhereAFileIsNotJson) {
  EXPECT_NE(FaultOfText("{\n  \"schema\": ,\n}").find("line 2, column 13"), std::string::npos)
      << FaultOfText("{\n  \"schema\": ,\n}");
  EXPECT_NE(FaultOfText("").find("not JSON"), std::string::npos);
  EXPECT_NE(FaultOfText("{\"schema\": \"\xff\"}").find("not JSON"), std::string::npos);
  EXPECT_NE(FaultOfText("{\"a\": NaN}").find("not JSON"), std::string::npos);
  EXPECT_NE(FaultOfText("{\"x\": \"1e999\",\n \"a\": [2, 1e999]}")
                .find("the number 1e999 at line 2, column 11 is larger"),
            std::string::npos)
      << FaultOfText("{\"x\": \"1e999\",\n \"a\": [2, 1e999]}");
  EXPECT_NE(FaultOfText("{\"a\": {\"b\": 1, \"b\": 2}}").find("\"b\" comes twice"),
            std::string::npos);
  EXPECT_NE(FaultOfText(std::string(200000, '[')).find("nested"), std::string::npos);
}

TEST(SceneIo, AFaultNamesItsLineKeyAndRange) {
  nlohmann::json scene = test::FullSceneJson();
  scene["tissues"][1]["pose"]["scale"] = -2;
  EXPECT_NE(FaultOfText(scene.dump(1))
                .find(": tissues[1].pose.scale is -2; it must be more than 0 "
                      "and at most 1000000"),
            std::string::npos)
      << FaultOfText(scene.dump(1));
  const std::string bad =
      "{\"schema\": \"arthroscene.scene/1\",\n \"backdrop\": {\"panorama\": \"p.png\", "
      "\"projection\": "
      "{\"type\": \"gnomonic\", \"centre_px\": [1, 1], \"focal_px\": 9},\n";
  EXPECT_NE(FaultOfText(bad + "  \"radius\": 70}}").find("line 3: backdrop.radius is 70"),
            std::string::npos);
  EXPECT_NE(FaultOfText(bad + "  \"raduis\": 1}}").find("line 3: backdrop.raduis is not known"),
            std::string::npos);
  EXPECT_NE(FaultOfText(bad + "  \"radius\": \"a\"}}").find("line 3: backdrop.radius is \"a\""),
            std::string::npos);
}

TEST(SceneIo, RefusesAMissingSceneAndAForeignFile) {
  test::TempFolder folder;
  EXPECT_NE(FaultOfReading(folder.path()).find("scene.json: could not be opened"),
            std::string::npos);
  WriteColourImage(folder / "p.png", ColourImage(4, 4));
  EXPECT_NE(FaultOfReading(folder / "p.png").find("not JSON"), std::string::npos);
}

// Any prefix of a file, and any byte changed, is read or refused: never a crash, never a hang.
TEST(SceneIo, SurvivesEveryCutAndManyChangedBytes) {
  const std::string whole = test::FullSceneJson().dump(1);
  test::TempFolder folder;
  int refused = 0;
  for (std::size_t end = 0; end < whole.size(); end += 7) {
    WriteAtomically(folder / "scene.json", whole.substr(0, end));
    refused += FaultOfReading(folder.path()).empty() ? 0 : 1;
    std::string changed = whole;
    changed[end] = static_cast<char>(changed[end] ^ 0x15);
    WriteAtomically(folder / "scene.json", changed);
    FaultOfReading(folder.path());
  }
  EXPECT_EQ(refused, static_cast<int>((whole.size() + 6) / 7));
}

TEST(SceneIo, ASceneThatCouldNotBeReadBackLeavesTheOldFile) {
  test::TempFolder folder;
  const fs::path file = folder / "scene.json";
  WriteScene(file, SmallScene());
  const std::string before = ReadWholeFile(file);
  Scene nan_ball = SmallScene(), nan_probed = SmallScene(), too_stiff = SmallScene(),
        nan_cut = SmallScene(), short_tear = SmallScene();
  for (Scene* scene : {&nan_ball, &nan_probed, &too_stiff, &nan_cut, &short_tear})
    scene->tissues.emplace_back().name = "a", scene->tissues.back().surface = "a.ply";
  nan_ball.tissues[0].fixed = {{{0, std::numeric_limits<double>::quiet_NaN(), 0}, 0.001}};
  nan_probed.tissues[0].probed = {{{0, 0, 0}, std::numeric_limits<double>::quiet_NaN()}};
  nan_cut.tissues[0].cuts = {CapsuleCut{{}, {}, std::numeric_limits<double>::quiet_NaN()}};
  short_tear.tissues[0].cuts = {TearCut{{{0, 0, 0}}}};
  too_stiff.tissues[0].elasticity.poisson_ratio = 0.5;
  Scene nan = SmallScene(), escape = SmallScene(), twins = SmallScene(), not_text = SmallScene();
  nan.backdrop.radius = std::numeric_limits<double>::quiet_NaN();
  escape.backdrop.panorama = "/somewhere/else.png";
  twins.tissues.resize(2);
  for (Tissue& tissue : twins.tissues) tissue.name = "a", tissue.surface = "a.ply";
  not_text.title = "\xff\xfe";
  for (const Scene& scene :
       {nan, nan_ball, nan_probed, too_stiff, nan_cut, short_tear, escape, twins, not_text}) {
    EXPECT_THROW(WriteScene(file, scene), Error);
    EXPECT_EQ(ReadWholeFile(file), before);
  }
  EXPECT_THROW(WriteScene(folder / "no/such/scene.json", SmallScene()), Error);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1)
      << "a partial file is left";
}

// The demo scene holds every number as it was written.
TEST(SceneIo, SavingTheDemoSceneGivesTheSameBytes) {
  const fs::path demo = fs::path(ARTHRO_SOURCE_DIR) / "resources/demo/scene.json";
  test::TempFolder folder;
  WriteScene(folder / "scene.json", ReadScene(demo));
  EXPECT_EQ(ReadWholeFile(folder / "scene.json"), ReadWholeFile(demo));
}

TEST(SceneIo, WritingTwiceGivesTheSameBytes) {
  test::TempFolder folder;
  WriteScene(folder / "a.json", SmallScene());
  WriteScene(folder / "b.json", ReadScene(folder / "a.json"));
  EXPECT_EQ(ReadWholeFile(folder / "a.json"), ReadWholeFile(folder / "b.json"));
}

}  // namespace
}  // namespace arthro

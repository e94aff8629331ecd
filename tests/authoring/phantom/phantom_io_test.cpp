// The phantom as files: a scene that loads, truth beside it, and nothing overwritten by accident.
#include "authoring/phantom/phantom_io.h"

#include <cmath>
#include <cstdio>
#include <fstream>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/scene/files/scene_check.h"
#include "simulation/scene/files/scene_io.h"
#include "simulation/scene/image_io.h"
#include "simulation/scene/mesh/mesh_io.h"
#include "tests/support/build_paths.h"
#include "tests/support/run_program.h"
#include "tests/support/temp_folder.h"

namespace arthro::authoring {
namespace {

namespace fs = std::filesystem;

PhantomOptions Small() {
  PhantomOptions options;
  options.size = PhantomSize::kSmall;
  return options;
}

// Made once, because drawing is slow.
const Phantom& SmallPhantom() {
  static const Phantom phantom = MakePhantom(Small());
  return phantom;
}

TEST(PhantomFolder, LoadsAsASceneWithBothTissues) {
  const test::TempFolder folder;
  WritePhantom(folder / "knee", SmallPhantom());
  const LoadedScene loaded = LoadScene(folder / "knee");
  EXPECT_EQ(loaded.panorama->width, 1024);
  EXPECT_EQ(loaded.depth->height, 768);
  ASSERT_EQ(loaded.surfaces.size(), 2u);
  // The meniscus deforms as a fixed volume, the cartilage as a layer on bone.
  const auto& tissues = loaded.scene.tissues;
  TetReadReport report;
  EXPECT_EQ(ReadTetMesh(folder / "knee" / tissues[0].mesh, &report).elements,
            SmallPhantom().meniscus.mesh.elements);
  EXPECT_TRUE(report.messages.empty());
  EXPECT_LT(fs::file_size(folder / "knee" / tissues[0].mesh), 300'000u);
  EXPECT_EQ(tissues[0].fixed, SmallPhantom().meniscus.fixed);
  EXPECT_TRUE(tissues[0].is_cuttable);
  EXPECT_TRUE(tissues[1].mesh.empty());
  EXPECT_FALSE(tissues[1].is_cuttable);
  EXPECT_EQ(loaded.surfaces[0]->vertices, SmallPhantom().meniscus.surface.vertices);
  EXPECT_EQ(loaded.depth->relief, SmallPhantom().without_tissues.depth.relief);
  EXPECT_TRUE(fs::exists(folder / "knee/panorama_with_tissue.png"));
  EXPECT_EQ(ReadDepthMap(folder / "knee/depth_with_tissue.tiff").relief,
            SmallPhantom().with_tissues.depth.relief);
}

TEST(PhantomFolder, StatesSideAndRightsOfEveryAsset) {
  const Scene scene = SceneOf(SmallPhantom());
  EXPECT_EQ(scene.side, BodySide::kRight);
  EXPECT_TRUE(MissingForSharing(scene).empty());
  EXPECT_EQ(MissingRights(scene.backdrop.depth_rights), "");
}

TEST(PhantomFolder, TruthPlacesTheMeniscusWhereItsLandmarksAre) {
  const nlohmann::json truth = TruthOf(SmallPhantom());
  EXPECT_EQ(truth["schema"], "arthroscene.phantom/1");
  int meniscus = 0;
  for (const auto& landmark : truth["landmarks"]) {
    const auto& x = landmark["x_in_portal"];
    const auto pixel = PixelFromDirection(SmallPhantom().projection, {x[0], x[1], x[2]});
    ASSERT_TRUE(pixel.has_value());
    EXPECT_NEAR(landmark["pixel"][0], pixel->x, 1e-9);
    if (landmark["name"].get<std::string>().starts_with("meniscus")) {
      // A vertex of the model in the pose of the file coincides with that landmark.
      const auto& pose = truth["tissues"]["medial meniscus"]["portal_from_tissue"];
      const Pose portal_from_tissue{{pose["position"][0], pose["position"][1], pose["position"][2]},
                                    {pose["quaternion"][0], pose["quaternion"][1],
                                     pose["quaternion"][2], pose["quaternion"][3]},
                                    pose["scale"]};
      double nearest = 1;
      for (const glm::dvec3& v : SmallPhantom().meniscus.surface.vertices)
        nearest =
            std::min(nearest, glm::distance(portal_from_tissue * v, glm::dvec3(x[0], x[1], x[2])));
      EXPECT_LT(nearest, 0.6e-3);  // half the distance between two rings
      ++meniscus;
    }
  }
  EXPECT_EQ(meniscus, 6);
}

TEST(PhantomFolder, DepthPacksToAThirdOfItsSize) {
  const test::TempFolder folder;
  WriteDepthMap(folder / "depth.tiff", SmallPhantom().without_tissues.depth);
  const double share =
      static_cast<double>(fs::file_size(folder / "depth.tiff")) / (1024.0 * 768 * 4);
  std::printf("depth.tiff: %.1f %% of its raw size\n", 100 * share);
  EXPECT_LT(share, 0.34);
}

TEST(PhantomFolder, ReplacesAnEarlierPhantomButNothingElse) {
  const test::TempFolder folder;
  fs::create_directory(folder / "knee");
  WritePhantom(folder / "knee", SmallPhantom());
  EXPECT_NO_THROW(WritePhantom(folder / "knee/", SmallPhantom()));
  std::ofstream(folder / "knee/notes.txt") << "mine";
  EXPECT_THROW(WritePhantom(folder / "knee", SmallPhantom()), Error);
  EXPECT_EQ(ReadWholeFile(folder / "knee/notes.txt"), "mine");
  // No unfinished file is left beside it.
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1);
}

TEST(PhantomFolder, RefusesAFileALinkAndAFolderInNoFolder) {
  const test::TempFolder folder;
  std::ofstream(folder / "file") << "x";
  fs::create_directory(folder / "empty");
  fs::create_directory_symlink(folder / "empty", folder / "link");
  EXPECT_THROW(RequirePhantomFolder(folder / "file"), Error);
  EXPECT_THROW(RequirePhantomFolder(folder / "link"), Error);
  EXPECT_THROW(RequirePhantomFolder(folder / "none/knee"), Error);
  EXPECT_NO_THROW(RequirePhantomFolder(folder / "empty"));
  EXPECT_NO_THROW(RequirePhantomFolder(folder / "new"));
}

TEST(PhantomJob, RefusesAForeignFolderAtOnceAndBadWordsAsUsage) {
  const test::TempFolder folder;
  std::ofstream(folder / "mine.txt") << "x";
  const auto refused = test::RunProgram("phantom --seed 1 --size S -o " + folder.path().string());
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_NE(refused.err.find("nothing is overwritten"), std::string::npos) << refused.err;
  EXPECT_EQ(test::RunProgram("phantom --size XL -o " + (folder / "a").string()).exit_code, 2);
  EXPECT_EQ(test::RunProgram("phantom --seed -1 -o " + (folder / "a").string()).exit_code, 2);
  EXPECT_EQ(test::RunProgram("phantom").exit_code, 2);
}

// The shipped demo is the output of its command. Pictures are compared as pixels: another
// processor's maths library may round a colour differently.
TEST(DemoScene, IsWhatItsCommandMakes) {
  const fs::path shipped = fs::path(ARTHRO_SOURCE_DIR) / "resources/demo";
  const test::TempFolder folder;
  const auto made =
      test::RunProgram("phantom --seed 1 --size M --picture jpg -o " + (folder / "demo").string());
  ASSERT_EQ(made.exit_code, 0) << made.err;
  for (const char* name : {"panorama.jpg", "panorama_with_tissue.jpg"}) {
    const ColourImage a = ReadColourImage(shipped / name),
                      b = ReadColourImage(folder / "demo" / name);
    ASSERT_EQ(a.rgb.size(), b.rgb.size());
    std::size_t off = 0;
    for (std::size_t i = 0; i < a.rgb.size(); ++i) off += std::abs(a.rgb[i] - b.rgb[i]) > 8;
    EXPECT_LT(off, a.rgb.size() / 10000) << name;
  }
  for (const char* name : {"depth.tiff", "depth_with_tissue.tiff"}) {
    const DepthMap a = ReadDepthMap(shipped / name), b = ReadDepthMap(folder / "demo" / name);
    ASSERT_EQ(a.relief.size(), b.relief.size());
    std::size_t off = 0;
    for (std::size_t i = 0; i < a.relief.size(); ++i)
      off += std::abs(a.relief[i] - b.relief[i]) > 2e-6f;
    EXPECT_LT(off, a.relief.size() / 100000) << name;  // a silhouette may fall into the next pixel
  }
  // Exercises, and the region that one of them removes, were added by hand.
  Scene scene = ReadScene(shipped);
  scene.exercises.clear();
  for (Tissue& tissue : scene.tissues) tissue.regions.clear();
  EXPECT_EQ(scene, ReadScene(folder / "demo"));
  EXPECT_EQ(ReadWholeFile(shipped / "trace.csv"), ReadWholeFile(folder / "demo/trace.csv"));
  const TetMesh mesh = ReadTetMesh(shipped / "meniscus.vtu"),
                made_mesh = ReadTetMesh(folder / "demo/meniscus.vtu");
  EXPECT_EQ(mesh.elements, made_mesh.elements);
  ASSERT_EQ(mesh.rest_positions.size(), made_mesh.rest_positions.size());
  for (std::size_t i = 0; i < mesh.rest_positions.size(); ++i)
    EXPECT_LT(glm::distance(mesh.rest_positions[i], made_mesh.rest_positions[i]), 1e-9);
  for (const char* name : {"meniscus.ply", "cartilage.ply"}) {
    const SurfaceMesh a = ReadSurface(shipped / name, 1.0),
                      b = ReadSurface(folder / "demo" / name, 1.0);
    EXPECT_EQ(a.triangles, b.triangles);
    ASSERT_EQ(a.vertices.size(), b.vertices.size());
    for (std::size_t i = 0; i < a.vertices.size(); ++i)
      EXPECT_LT(glm::distance(a.vertices[i], b.vertices[i]), 1e-9);
  }
}

}  // namespace
}  // namespace arthro::authoring

// A copy that is written again and again: what it holds, and what is not written twice.
#include "authoring/project/incremental_copy.h"

#include <fstream>

#include <gtest/gtest.h>

#include "authoring/project/document_io.h"
#include "simulation/core/atomic_file.h"
#include "simulation/scene/files/scene_io.h"
#include "simulation/scene/mesh/mesh_io.h"
#include "tests/support/small_scene.h"
#include "tests/support/temp_folder.h"

namespace arthro::authoring {
namespace {

namespace fs = std::filesystem;

void WriteOneTetrahedron(const fs::path& file, double size) {
  TetMesh mesh;
  mesh.rest_positions = {{0, 0, 0}, {size, 0, 0}, {0, size, 0}, {0, 0, size}};
  mesh.elements = {0, 1, 2, 3};
  WriteTetMesh(file, mesh);
}

class CopyOfDocument : public testing::Test {
 protected:
  Document Written() const { return OpenDocument(temp / "copy"); }
  test::TempFolder temp;
  Document document = OpenDocument(test::WriteSmallScene(temp / "knee"));
  IncrementalCopy copy{temp / "copy"};
};

TEST_F(CopyOfDocument, HoldsEveryPart) {
  document.scene.portals.incision_spacing = 0.021;
  document.scene.extensions["x-other"] = "3";
  copy.Write(document);
  const Document back = Written();
  EXPECT_EQ(back.scene.portals.incision_spacing, 0.021);
  EXPECT_EQ(back.scene.extensions.at("x-other"), "3");
  EXPECT_EQ(back.panorama->rgb, document.panorama->rgb);
  EXPECT_EQ(back.depth->relief, document.depth->relief);
  EXPECT_EQ(back.surfaces[0]->vertices, document.surfaces[0]->vertices);
}

TEST_F(CopyOfDocument, PartsThatHaveNotChangedAreNotWrittenAgain) {
  copy.Write(document);
  const fs::path panorama = temp / "copy" / Written().scene.backdrop.panorama;
  const auto earlier = fs::file_time_type::clock::now() - std::chrono::hours(1);
  fs::last_write_time(panorama, earlier);
  for (int i = 0; i < 5; ++i) {
    document.depth = Share(DepthMap(400, 300, 0.001f * static_cast<float>(i)));
    document.is_depth_imported = true;
    document.scene.title = "edit " + std::to_string(i);
    copy.Write(document);
    const Document back = Written();
    EXPECT_EQ(back.scene.title, document.scene.title);
    EXPECT_EQ(back.depth->relief, document.depth->relief);
  }
  EXPECT_EQ(fs::last_write_time(panorama), earlier);
  int maps = 0;
  for (const auto& entry : fs::directory_iterator(temp / "copy"))
    maps += entry.path().extension() == ".tiff";
  EXPECT_EQ(maps, 1) << "maps that nothing names are removed";
}

// Two steps of the history name one file for different tetrahedra.
TEST_F(CopyOfDocument, TetrahedraFollowTheFileThatTheDocumentNames) {
  WriteOneTetrahedron(temp / "coarse.vtu", 0.001);
  WriteOneTetrahedron(temp / "fine.vtu", 0.002);
  const auto bytes = [](const fs::path& file) { return ReadTetMesh(file).rest_positions[1].x; };
  document.scene.tissues[0].mesh = "tissues/m.vtu";
  for (const char* name : {"coarse.vtu", "fine.vtu", "coarse.vtu"}) {
    document.files["tissues/m.vtu"] = {temp / name, {}, {}};
    copy.Write(document);
    copy.Write(document);
    const Document back = Written();
    EXPECT_EQ(bytes(FileOf(back, back.scene.tissues[0].mesh)), bytes(temp / name)) << name;
  }
}

TEST_F(CopyOfDocument, ALensThatChangedInMemoryIsTheOneThatIsKept) {
  document.scene.scope.lens = "lens.json";
  document.lens.emplace();
  document.lens->width = document.lens->height = 100;
  document.lens->field_of_view = 1.2;
  for (const double focal : {50.0, 60.0, 60.0, 50.0}) {
    document.lens->focal_px = focal;
    copy.Write(document);
    EXPECT_EQ(Written().lens->focal_px, focal);
  }
}

TEST_F(CopyOfDocument, AWriteThatFailsLeavesTheOneBefore) {
  copy.Write(document);
  Document broken = document;
  broken.scene.title = "broken";
  broken.surfaces[0] = nullptr;
  EXPECT_ANY_THROW(copy.Write(broken));
  EXPECT_EQ(Written().scene.title, "Small knee");
  document.scene.title = "next";
  copy.Write(document);
  EXPECT_EQ(Written().scene.title, "next");
}

}  // namespace
}  // namespace arthro::authoring

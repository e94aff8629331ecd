// Surfaces of one knee that are imported one by one, without a window.
#include "app/steps/tissue/import_frames.h"

#include <memory>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

#include "app/editor/every_step.h"
#include "app/files/scene_files.h"
#include "app/state/command.h"
#include "app/steps/tissue/tissue_step.h"
#include "authoring/alignment/place_by_hand.h"
#include "authoring/project/document_io.h"
#include "simulation/core/units.h"
#include "tests/support/shapes.h"
#include "tests/support/temp_folder.h"

namespace arthro::app {
namespace {

// A sphere of 50 mm with a relief of 10 mm everywhere.
class ImportFramesTest : public testing::Test {
 protected:
  ImportFramesTest() {
    authoring::Document document = NewDocument();
    document.panorama = Share(ColourImage(400, 300));
    document.scene.backdrop.projection.centre_px = {199.5, 149.5};
    document.scene.backdrop.projection.focal_px = 150;
    document.depth = Share(DepthMap(400, 300, 0.01f));
    state.reset(new EditorState(MakeEditorState(std::move(document))));
  }
  // A ball in the coordinates of the file, mm.
  void Import(const std::string& file, const glm::dvec3& middle_mm, bool keeps_place) {
    state->steps.tissue->imports->keeps_place = keeps_place;
    ImportSurface(*state, file, test::Sphere(middle_mm, 4.0, 2), "mm");
  }
  const std::vector<Tissue>& Tissues() const { return state->document().scene.tissues; }
  glm::dvec3 MiddleOf(std::size_t i) const {
    glm::dvec3 sum(0.0);
    const auto& surface = *state->document().surfaces[i];
    for (const glm::dvec3& x : surface.vertices) sum += Tissues()[i].pose * x;
    return sum / static_cast<double>(surface.vertices.size());
  }
  std::unique_ptr<EditorState> state;
};

TEST_F(ImportFramesTest, AnImportedSurfaceLiesOnTheRelief) {
  Import("/knee/a.stl", {100, 200, 300}, false);
  ASSERT_EQ(Tissues().size(), 1u);
  EXPECT_EQ(Tissues()[0].name, "a");
  // The relief is 40 mm from the portal, the ball has a radius of 4 mm, and some of it may be
  // lifted out by 6 mm at most.
  const double range = glm::length(MiddleOf(0)) / kMm;
  EXPECT_GT(range, 40 - 4 - 6 - 1);
  EXPECT_LT(range, 40 - 4 + 1);
}

// A sheet in the file's xy plane faces the portal, whichever way its triangles are turned.
TEST_F(ImportFramesTest, AnOpenSheetFacesThePortal) {
  for (const bool is_turned : {false, true}) {
    SurfaceMesh sheet{{{0, 0, 0}, {8, 0, 0}, {8, 6, 0}, {0, 6, 0}, {4, 3, 0.5}}, {}};
    sheet.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
    if (is_turned)
      for (auto& t : sheet.triangles) std::swap(t[1], t[2]);
    state->steps.tissue->imports->keeps_place = false;
    ImportSurface(*state, "/knee/sheet.stl", sheet, "mm");
    const glm::dvec3 facing =
        Tissues().back().pose.quaternion * authoring::FacingOf(*state->document().surfaces.back());
    EXPECT_LT(glm::dot(facing, Tissues().back().pose.position), 0) << is_turned;
  }
}

TEST_F(ImportFramesTest, ASecondSurfaceKeepsItsPlaceBesideTheFirst) {
  Import("/knee/a.stl", {100, 200, 300}, false);
  PlaceTissue(*state, 0, {{0.001, 0.002, 0.03}, glm::angleAxis(0.3, glm::dvec3(0, 0, 1)), 1.0},
              "Move");
  Import("/knee/b.stl", {110, 200, 300}, true);
  ASSERT_EQ(Tissues().size(), 2u);
  EXPECT_EQ(Tissues()[1].pose, Tissues()[0].pose);
  const glm::dvec3 wanted =
      MiddleOf(0) + Tissues()[0].pose.quaternion * (glm::dvec3(10, 0, 0) * kMm);
  EXPECT_LT(glm::distance(MiddleOf(1), wanted), 1e-9);
  EXPECT_EQ(ImportedTogether(*state, 0), std::vector<int>{1});
  Import("/other/c.stl", {0, 0, 0}, false);
  EXPECT_TRUE(ImportedTogether(*state, 2).empty());
}

TEST_F(ImportFramesTest, AFileThatIsNamedAfterAMaterialGetsIt) {
  simulation::TissuePreset& cartilage = state->tissue_presets.emplace_back();
  cartilage.name = "cartilage-probe";
  cartilage.words = {"cartilage"};
  Import("/knee/R-tibia-Cartilage.stl", {0, 0, 0}, false);
  Import("/knee/body.stl", {0, 0, 0}, false);
  EXPECT_EQ(Tissues()[0].material, "cartilage");
  EXPECT_EQ(Tissues()[1].material, Tissue().material);
}

TEST_F(ImportFramesTest, AGroupIsPlacedAsOneByOneStep) {
  Import("/knee/a.stl", {0, 0, 0}, false);
  Import("/knee/b.stl", {12, 0, 0}, true);
  const double apart = glm::distance(MiddleOf(0), MiddleOf(1));
  state->steps.tissue->imports->moves_together = true;
  PlaceTissue(*state, 1, {{0.004, 0, 0.02}, glm::angleAxis(1.0, glm::dvec3(1, 0, 0)), 1.2}, "Move");
  EXPECT_NEAR(glm::distance(MiddleOf(0), MiddleOf(1)), 1.2 * apart, 1e-9);
  EXPECT_EQ(Tissues()[0].pose.scale, 1.2);
  app::Run(*state, "undo");
  EXPECT_EQ(Tissues()[0].pose.scale, 1.0);
  EXPECT_NEAR(glm::distance(MiddleOf(0), MiddleOf(1)), apart, 1e-12);
}

TEST_F(ImportFramesTest, AGroupIsKeptWithTheScene) {
  Import("/knee/a.stl", {100, 200, 300}, false);
  Import("/knee/b.stl", {112, 200, 300}, true);
  const test::TempFolder temp;
  authoring::SaveDocument(state->document(), temp / "saved");
  StartDocument(*state, authoring::OpenDocument(temp / "saved"), true);
  EXPECT_EQ(ImportedTogether(*state, 0), std::vector<int>{1});
  state->tissue = 0;
  Import("/knee/c.stl", {100, 212, 300}, true);
  ASSERT_EQ(Tissues().size(), 3u);
  EXPECT_NEAR(glm::distance(MiddleOf(2), MiddleOf(0)), 12 * kMm, 1e-9)
      << "it finds its place beside what was imported in an earlier session";
}

TEST_F(ImportFramesTest, OnlyAFileFromBesideItIsALikelyPartner) {
  EXPECT_EQ(PartnerOfImport(*state), -1);
  Import("/knee/a.stl", {0, 0, 0}, false);
  const SurfaceMesh near = test::Sphere({40, 0, 0}, 4.0, 1), far = test::Sphere({400, 0, 0}, 4, 1);
  EXPECT_TRUE(IsLikelyPartner(*state, "/knee/b.stl", near, kMm));
  EXPECT_FALSE(IsLikelyPartner(*state, "/knee/b.stl", far, kMm));
  EXPECT_FALSE(IsLikelyPartner(*state, "/other/b.stl", near, kMm));
}

}  // namespace
}  // namespace arthro::app

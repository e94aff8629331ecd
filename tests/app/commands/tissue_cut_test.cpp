// The author's cuts, without a window.
#include "app/steps/tissue/cut/tissue_cut.h"

#include <algorithm>
#include <memory>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "app/editor/every_step.h"
#include "app/files/scene_files.h"
#include "app/state/command.h"
#include "app/state/edits.h"
#include "app/steps/tissue/cut/cut_skins.h"
#include "simulation/core/units.h"
#include "tests/support/shapes.h"

namespace arthro::app {
namespace {

// A block of 12 × 8 × 4 mm, its top at z = 0, laid in at `scale` times that.
class TissueCut : public testing::Test {
 protected:
  void Open(double scale = 1) {
    authoring::Document document = NewDocument();
    Tissue& tissue = document.scene.tissues.emplace_back();
    tissue.name = "block";
    tissue.surface = "block.ply";
    tissue.mesh = "block.vtu";
    tissue.pose.scale = scale;
    document.surfaces.push_back(std::make_shared<const SurfaceMesh>(
        test::Box(glm::dvec3(-6, -4, -4) * kMm, glm::dvec3(6, 4, 0) * kMm)));
    state.reset(new EditorState(MakeEditorState(std::move(document))));
    state->tissue = 0;
  }
  const Tissue& Block() const { return state->document().scene.tissues[0]; }
  std::unique_ptr<EditorState> state;
};

TEST_F(TissueCut, ATearIsClickedPointByPointAndUndonePointByPoint) {
  Open(2);
  app::Run(*state, "cut-tear");
  UseCutBrush(*state, 0, glm::dvec3(-3, 0, 0) * kMm);
  EXPECT_TRUE(Block().cuts.empty()) << "one point is no tear yet";
  EXPECT_FALSE(state->history.CanUndo());
  UseCutBrush(*state, 0, glm::dvec3(0, 1, 0) * kMm);
  ASSERT_EQ(Block().cuts.size(), 1u);
  UseCutBrush(*state, 0, glm::dvec3(3, 0, 0) * kMm);
  ASSERT_EQ(Block().cuts.size(), 1u) << "the third point lengthens it";
  const auto& tear = std::get<TearCut>(Block().cuts[0]);
  EXPECT_EQ(tear.path.size(), 3u);
  EXPECT_LT(glm::distance(tear.into, glm::dvec3(0, 0, -1)), 1e-12) << "into the block";
  EXPECT_NEAR(2 * tear.depth, state->steps.tissue->cut_brush.depth, 1e-15)
      << "its size is of the joint";
  EXPECT_EQ(CutName(Block(), 0), "Tear 1");
  EXPECT_EQ(CutWords(Block(), 0), "3 points, 12.6 mm long");

  SetTearDepth(*state, 6 * kMm);
  SetTearDepth(*state, 5 * kMm);
  EndDrag(*state);
  EXPECT_NEAR(std::get<TearCut>(Block().cuts[0]).depth, 2.5 * kMm, 1e-15);
  app::Run(*state, "undo");
  EXPECT_NEAR(std::get<TearCut>(Block().cuts[0]).depth, 4 * kMm, 1e-15) << "a drag is one step";
  app::Run(*state, "undo");
  EXPECT_EQ(std::get<TearCut>(Block().cuts[0]).path.size(), 2u);
  app::Run(*state, "undo");
  EXPECT_TRUE(Block().cuts.empty());
  app::Run(*state, "redo");
  EXPECT_EQ(Block().cuts.size(), 1u);

  // Pressed again: put away. And again: another tear.
  app::Run(*state, "cut-tear");
  UseCutBrush(*state, 0, glm::dvec3(3, 3, 0) * kMm);
  EXPECT_EQ(std::get<TearCut>(Block().cuts[0]).path.size(), 2u);
  app::Run(*state, "cut-tear");
  UseCutBrush(*state, 0, glm::dvec3(3, 3, 0) * kMm);
  UseCutBrush(*state, 0, glm::dvec3(3, -3, 0) * kMm);
  EXPECT_EQ(Block().cuts.size(), 2u);
}

TEST_F(TissueCut, BitesAndRegionsAreAddedChangedAndRemoved) {
  Open();
  app::Run(*state, "cut-bite");
  UseCutBrush(*state, 0, glm::dvec3(6, 0, 0) * kMm);
  UseCutBrush(*state, 0, glm::dvec3(-6, 0, 0) * kMm);
  SetBiteRadius(*state, 1 * kMm);
  EndDrag(*state);
  ASSERT_EQ(Block().cuts.size(), 2u);
  EXPECT_EQ(std::get<CapsuleCut>(Block().cuts[1]).radius, 1 * kMm);
  EXPECT_NE(std::get<CapsuleCut>(Block().cuts[0]).radius, 1 * kMm);
  EXPECT_EQ(CutWords(Block(), 1), "round, radius 1.0 mm");
  app::Run(*state, "remove-cut");
  ASSERT_EQ(Block().cuts.size(), 1u);
  EXPECT_EQ(std::get<CapsuleCut>(Block().cuts[0]).a.x, 6 * kMm);
  app::Run(*state, "remove-all-cuts");
  EXPECT_TRUE(Block().cuts.empty());
  EXPECT_FALSE(CommandOf(*state, "remove-all-cuts").enabled(*state));
  app::Run(*state, "undo");
  app::Run(*state, "undo");
  EXPECT_EQ(Block().cuts.size(), 2u);

  app::Run(*state, "cut-region");
  UseCutBrush(*state, 0, glm::dvec3(6, 0, 0) * kMm);
  UseCutBrush(*state, 0, glm::dvec3(-6, 0, 0) * kMm);
  ASSERT_EQ(Block().regions.size(), 2u);
  EXPECT_EQ(Block().regions[1].name, "region 2");
  for (const char* refused : {"", "region 1", "elsewhere"}) {
    RenameRegion(*state, refused);
    EXPECT_EQ(Block().regions[1].name, "region 2") << refused;
  }
  RenameRegion(*state, "posterior horn");
  SetRegionRadius(*state, 7 * kMm);
  EndDrag(*state);
  EXPECT_EQ(Block().regions[1], (Region{"posterior horn", {glm::dvec3(-6, 0, 0) * kMm, 7 * kMm}}));
  app::Run(*state, "remove-region");
  EXPECT_EQ(Block().regions.size(), 1u);
}

TEST_F(TissueCut, WithoutTetrahedraNothingIsCutAndItIsSaid) {
  Open();
  Tissue bare = Block();
  bare.mesh.clear();
  SetTissue(*state, 0, bare, "Empty");
  app::Run(*state, "cut-bite");
  UseCutBrush(*state, 0, glm::dvec3(6, 0, 0) * kMm);
  EXPECT_TRUE(Block().cuts.empty());
  EXPECT_NE(state->message.find("has no tetrahedra yet"), std::string::npos);
}

TEST_F(TissueCut, ThePictureIsOfTheCutTissueAndKeptWhileNothingChanges) {
  Open(2);
  CutSkins skins;
  EXPECT_EQ(skins.SkinOf(state->document(), 0), nullptr) << "it is whole";
  app::Run(*state, "cut-bite");
  UseCutBrush(*state, 0, glm::dvec3(6, 0, 0) * kMm);
  const auto bitten = skins.SkinOf(state->document(), 0);
  ASSERT_NE(bitten, nullptr);
  EXPECT_GT(std::ranges::count(bitten->is_fresh, 1), 20) << "its walls are pale";
  // A face of a cut passes through the surface by a tenth of the field's spacing (carved_skin.h),
  // which is at most 0.2 mm.
  for (const glm::dvec3& x : bitten->surface.vertices)
    ASSERT_LT(std::max(std::abs(x.x), std::abs(x.y)), 6.02 * kMm) << "in the tissue's own frame";
  EXPECT_EQ(skins.SkinOf(state->document(), 0), bitten);
  Tissue named = Block();
  named.name = "labrum";
  SetTissue(*state, 0, named, "Rename");
  EXPECT_EQ(skins.SkinOf(state->document(), 0), bitten);
  app::Run(*state, "undo");
  app::Run(*state, "undo");
  EXPECT_EQ(skins.SkinOf(state->document(), 0), nullptr);
  EXPECT_EQ(skins.fault(), "");

  // A cut that leaves nothing: shown whole, and said.
  Tissue gone = Block();
  gone.cuts = {CapsuleCut{{}, {}, 0.05}};
  SetTissue(*state, 0, gone, "Bite");
  EXPECT_EQ(skins.SkinOf(state->document(), 0), nullptr);
  EXPECT_NE(skins.fault().find("block: its cuts leave nothing of it"), std::string::npos);
}

}  // namespace
}  // namespace arthro::app

// Landmarks that an author pairs by clicks, without a window.
#include "app/steps/tissue/landmark_mode.h"

#include <memory>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "app/editor/every_step.h"
#include "app/files/scene_files.h"
#include "app/state/command.h"
#include "app/state/edits.h"
#include "app/steps/tissue/tissue_step.h"
#include "authoring/alignment/placing_notes.h"
#include "authoring/project/document_io.h"
#include "simulation/core/units.h"
#include "tests/support/shapes.h"
#include "tests/support/temp_folder.h"

namespace arthro::app {
namespace {

// A sphere of 50 mm without relief, and a block in front of the scope.
class Landmarks : public testing::Test {
 protected:
  void SetUp() override {
    authoring::Document document = NewDocument();
    document.panorama = Share(ColourImage(400, 300));
    document.scene.backdrop.projection.centre_px = {199.5, 149.5};
    document.scene.backdrop.projection.focal_px = 150;
    DepthMap depth(400, 300);
    for (int u = 0; u < 400; ++u) depth.at(u, 0) = std::nanf("");
    document.depth = Share(std::move(depth));
    for (const char* name : {"block", "other"}) {
      Tissue& tissue = document.scene.tissues.emplace_back();
      tissue.name = name;
      tissue.surface = "block.ply";
      tissue.pose.position = glm::dvec3(0, 0, 30) * kMm;
      document.surfaces.push_back(
          Share(test::Box(glm::dvec3(-10, -6, -2) * kMm, glm::dvec3(10, 6, 2) * kMm)));
    }
    state.reset(new EditorState(MakeEditorState(std::move(document))));
    state->tissue = 0;
    state->step = Step::kTissue;
  }
  void ClickScene(const glm::dvec2& pixel) {
    TakeScenePoint(*state, authoring::SightOfPanorama(state->document().scene.backdrop, pixel));
  }
  LandmarkMode& Mode() { return state->steps.tissue->landmarks; }
  // Pairs whose partners are model points that a rigid motion takes onto the sphere.
  void MakePairs() {
    const glm::dvec2 pixels[] = {{170, 130}, {230, 130}, {230, 170}, {170, 172}};
    const Pose shift{glm::dvec3(2, 1, 40) * kMm, glm::dquat(1, 0, 0, 0), 1.0};
    for (const glm::dvec2& pixel : pixels) {
      const auto place = authoring::PointOnRelief(
          state->document(), authoring::SightOfPanorama(state->document().scene.backdrop, pixel));
      TakeModelPoint(*state, 0, place->x_in_portal - shift.position);
      ClickScene(pixel);
    }
  }
  std::unique_ptr<EditorState> state;
};

TEST_F(Landmarks, HalvesOfAPairMayBeClickedInEitherOrder) {
  app::Run(*state, "landmarks");
  ASSERT_TRUE(PlacesLandmarks(*state));
  EXPECT_EQ(state->message,
            "Click a point of block in the overview, or its place in the scope's picture.");
  TakeModelPoint(*state, 0, glm::dvec3(1, 2, 3) * kMm);
  EXPECT_TRUE(Mode().pairs.empty());
  ClickScene({180, 150});
  ASSERT_EQ(Mode().pairs.size(), 1u);
  ClickScene({220, 150});
  EXPECT_EQ(state->message, "Now click the same point of block in the overview.");
  TakeModelPoint(*state, 0, glm::dvec3(4, 2, 3) * kMm);
  ASSERT_EQ(Mode().pairs.size(), 2u);
  EXPECT_EQ(Mode().pairs[1].x_in_tissue, glm::dvec3(4, 2, 3) * kMm);
  app::Run(*state, "undo");
  KeepLandmarksFresh(*state);
  EXPECT_EQ(Mode().pairs.size(), 1u) << "a pair is one step of the history";
  app::Run(*state, "redo");
  KeepLandmarksFresh(*state);
  EXPECT_EQ(Mode().pairs.size(), 2u);
}

TEST_F(Landmarks, AlignIsOneStepThatCanBeUndone) {
  app::Run(*state, "landmarks");
  EXPECT_FALSE(CommandOf(*state, "align-landmarks").enabled(*state));
  MakePairs();
  ASSERT_TRUE(Mode().alignment.is_aligned()) << Mode().alignment.sentence;
  const Pose before = state->document().scene.tissues[0].pose;
  app::Run(*state, "align-landmarks");
  const Pose after = state->document().scene.tissues[0].pose;
  EXPECT_LT(glm::distance(after.position, glm::dvec3(2, 1, 40) * kMm), 1e-6);
  EXPECT_EQ(state->message, "Aligned block to 0.00 mm rms.");
  app::Run(*state, "undo");
  EXPECT_EQ(state->document().scene.tissues[0].pose, before);
  EXPECT_EQ(Mode().pairs.size(), 4u) << "the landmarks stay for another try";
  app::Run(*state, "redo");
  EXPECT_EQ(state->document().scene.tissues[0].pose, after);
}

TEST_F(Landmarks, AHoleIsRefusedInWords) {
  app::Run(*state, "landmarks");
  TakeModelPoint(*state, 0, glm::dvec3(0.0));
  ClickScene({200, 0});
  EXPECT_TRUE(Mode().pairs.empty());
  EXPECT_EQ(state->message, authoring::kNothingImaged);
}

TEST_F(Landmarks, ADepthFromBrightnessIsAGuessHoweverLittleItsNoise) {
  for (const bool is_imported : {false, true}) {
    authoring::Document document = state->document();
    document.depth_sigma = Share(DepthMap(400, 300, 0.0002f));
    document.is_depth_imported = is_imported;
    StartDocument(*state, std::move(document), true);
    state->tissue = 0;
    state->step = Step::kTissue;
    app::Run(*state, "landmarks");
    if (Mode().pairs.empty()) MakePairs();
    ASSERT_EQ(Mode().pairs.size(), 4u);
    EXPECT_EQ(Mode().pairs[0].scene.is_guessed, !is_imported);
    EXPECT_EQ(Mode().pairs[0].scene.range_sigma > 2e-3, !is_imported);
    app::Run(*state, "leave-landmarks");
  }
}

TEST_F(Landmarks, AClickOnAnotherTissueIsRefusedInWords) {
  app::Run(*state, "landmarks");
  TakeModelPoint(*state, 1, glm::dvec3(0.0));
  EXPECT_FALSE(Mode().model);
  EXPECT_EQ(state->message, "Another tissue was clicked; click on block.");
}

TEST_F(Landmarks, PairsAreLeftOutAndRemoved) {
  app::Run(*state, "landmarks");
  MakePairs();
  LeaveOutLandmark(*state, 1, true);
  EXPECT_FALSE(Mode().alignment.residuals[1].is_used);
  EXPECT_TRUE(Mode().alignment.is_aligned());
  ChooseLandmark(*state, 0);
  app::Run(*state, "remove-landmark");
  EXPECT_EQ(Mode().pairs.size(), 3u);
  EXPECT_EQ(Mode().alignment.verdict, authoring::AlignVerdict::kTooFew);
  app::Run(*state, "remove-all-landmarks");
  EXPECT_TRUE(Mode().pairs.empty());
}

TEST_F(Landmarks, LeavingKeepsThePairsOfEachTissue) {
  app::Run(*state, "landmarks");
  MakePairs();
  app::Run(*state, "leave-landmarks");
  EXPECT_FALSE(PlacesLandmarks(*state));
  TakeModelPoint(*state, 0, glm::dvec3(0.0));
  EXPECT_FALSE(Mode().model) << "clicks place nothing any more";
  app::Run(*state, "landmarks");
  EXPECT_EQ(Mode().pairs.size(), 4u);
  state->tissue = 1;
  EXPECT_FALSE(PlacesLandmarks(*state));
  app::Run(*state, "landmarks");
  EXPECT_TRUE(Mode().pairs.empty());
  app::Run(*state, "leave-landmarks");
  state->tissue = 0;
  app::Run(*state, "landmarks");
  EXPECT_EQ(Mode().pairs.size(), 4u) << "those of the first tissue are still there";
  EXPECT_TRUE(Mode().alignment.is_aligned());
}

TEST_F(Landmarks, AreKeptWithTheSceneUnderTheNameOfTheirTissue) {
  app::Run(*state, "landmarks");
  SolveForScale(*state, true);
  MakePairs();
  LeaveOutLandmark(*state, 2, true);
  const std::vector<authoring::LandmarkPair> pairs = Mode().pairs;
  app::Run(*state, "leave-landmarks");
  Tissue renamed = state->document().scene.tissues[0];
  renamed.name = "slab";
  SetTissue(*state, 0, renamed, "Rename");
  const test::TempFolder temp;
  authoring::SaveDocument(state->document(), temp / "saved");
  StartDocument(*state, authoring::OpenDocument(temp / "saved"), true);
  state->tissue = 0;
  state->step = Step::kTissue;
  app::Run(*state, "landmarks");
  ASSERT_EQ(Mode().pairs.size(), pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    EXPECT_EQ(Mode().pairs[i].x_in_tissue, pairs[i].x_in_tissue);
    EXPECT_LT(glm::distance(Mode().pairs[i].scene.x_in_portal, pairs[i].scene.x_in_portal), 1e-9);
    EXPECT_EQ(Mode().pairs[i].is_left_out, i == 2);
  }
  EXPECT_TRUE(Mode().solves_scale);
  RemoveTissue(*state, 0);
  EXPECT_FALSE(state->document().scene.extensions.contains(authoring::kPlacingKey))
      << "they go with their tissue";
}

// A click is a line of sight: on another relief it meets another place.
TEST_F(Landmarks, FollowTheRelief) {
  app::Run(*state, "landmarks");
  MakePairs();
  Edit(*state, "Raise the relief", "", [](authoring::Document& next) {
    next.depth = Share(DepthMap(next.depth->width, next.depth->height, 0.01f));
  });
  KeepLandmarksFresh(*state);
  for (const authoring::LandmarkPair& pair : Mode().pairs)
    EXPECT_NEAR(glm::length(pair.scene.x_in_portal), 0.04, 1e-4);
}

TEST_F(Landmarks, TheTissueCanBeShownAsItWasBeforeTheAlignment) {
  app::Run(*state, "landmarks");
  MakePairs();
  const Pose before = state->document().scene.tissues[0].pose;
  EXPECT_FALSE(CommandOf(*state, "show-before").enabled(*state));
  app::Run(*state, "align-landmarks");
  EXPECT_FALSE(ShownBefore(*state));
  app::Run(*state, "show-before");
  EXPECT_EQ(ShownBefore(*state), before);
  EXPECT_NE(state->document().scene.tissues[0].pose, before) << "only shown";
  app::Run(*state, "show-before");
  EXPECT_FALSE(ShownBefore(*state));
}

}  // namespace
}  // namespace arthro::app

// Placing a tissue by hand, without a window.
#include "app/steps/tissue/hand_placing.h"

#include <memory>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "app/editor/every_step.h"
#include "app/files/scene_files.h"
#include "app/state/command.h"
#include "app/state/edits.h"
#include "app/steps/tissue/tissue_step.h"
#include "simulation/core/units.h"
#include "tests/support/shapes.h"

namespace arthro::app {
namespace {

// A sphere of 50 mm without relief, and a block in front of it.
class HandPlacingTest : public testing::Test {
 protected:
  void SetUp() override {
    authoring::Document document = NewDocument();
    document.panorama = Share(ColourImage(400, 300));
    document.scene.backdrop.projection.centre_px = {199.5, 149.5};
    document.scene.backdrop.projection.focal_px = 150;
    Tissue& tissue = document.scene.tissues.emplace_back();
    tissue.name = "block";
    tissue.surface = "block.ply";
    tissue.mesh = "block.vtu";
    tissue.pose.position = glm::dvec3(0, 0, 44) * kMm;
    document.surfaces.push_back(
        Share(test::Box(glm::dvec3(-4, -3, -2) * kMm, glm::dvec3(4, 3, 2) * kMm)));
    state.reset(new EditorState(MakeEditorState(std::move(document))));
    state->tissue = 0;
    state->step = Step::kTissue;
  }
  const Tissue& Block() const { return state->document().scene.tissues[0]; }
  std::unique_ptr<EditorState> state;
};

TEST_F(HandPlacingTest, StepsMoveAndTurnAndAreUndoneOneByOne) {
  state->steps.tissue->placing.step = 2 * kMm;
  app::Run(*state, "nudge-right");
  app::Run(*state, "nudge-right");
  app::Run(*state, "nudge-up");
  EXPECT_LT(glm::distance(Block().pose.position, glm::dvec3(4, -2, 44) * kMm), 1e-12);
  app::Run(*state, "turn-clockwise");
  EXPECT_NEAR(glm::angle(Block().pose.quaternion), state->steps.tissue->placing.turn, 1e-9);
  app::Run(*state, "undo");
  app::Run(*state, "undo");
  app::Run(*state, "undo");
  EXPECT_LT(glm::distance(Block().pose.position, glm::dvec3(2, 0, 44) * kMm), 1e-12);
  state->step = Step::kPortals;
  EXPECT_FALSE(CommandOf(*state, "nudge-right").enabled(*state));
}

TEST_F(HandPlacingTest, TheFitFollowsThePoseAndNamesAnIntersection) {
  // The front of the block is at 42 mm, the sphere at 50 mm.
  EXPECT_NEAR(FitOfChosen(*state).median, 8 * kMm, 0.5 * kMm);
  EXPECT_EQ(IntersectionWords(FitOfChosen(*state)), "");
  Tissue changed = Block();
  changed.pose.position.z = 0.054;
  SetTissue(*state, 0, changed, "Move");
  EXPECT_NE(IntersectionWords(FitOfChosen(*state)).find("100 % of its front lies behind"),
            std::string::npos)
      << IntersectionWords(FitOfChosen(*state));
  changed.pose.position.z = 0.001;
  SetTissue(*state, 0, changed, "Move");
  EXPECT_EQ(FitWords(FitOfChosen(*state)), "It is nowhere near the relief.");
}

TEST_F(HandPlacingTest, AMirrorImageIsOneStepAndLosesItsTetrahedra) {
  app::Run(*state, "mirror-tissue");
  EXPECT_TRUE(Block().mesh.empty());
  EXPECT_EQ(state->message, "Mirror block; make its tetrahedra anew.");
  app::Run(*state, "undo");
  EXPECT_EQ(Block().mesh, "block.vtu");
}

TEST_F(HandPlacingTest, ADragLaysTheBaseOntoTheReliefAsOneStep) {
  app::Run(*state, "lay-on-relief");
  ASSERT_TRUE(LaysOnRelief(*state));
  const Backdrop backdrop = state->document().scene.backdrop;  // edits move the document
  for (const double u : {200.0, 220.0, 240.0})
    LayTissue(*state, authoring::SightOfPanorama(backdrop, {u, 150}));
  EndDrag(*state);
  const glm::dvec3 place = 0.05 * DirectionFromPixel(backdrop.projection, {240, 150});
  // Half of the block's height in front of the place; cells of the relief are flat.
  EXPECT_NEAR(glm::distance(Block().pose.position, place), 2 * kMm, 0.05 * kMm);
  app::Run(*state, "undo");
  EXPECT_EQ(Block().pose.position, glm::dvec3(0, 0, 44) * kMm);
  app::Run(*state, "lay-on-relief");
  EXPECT_FALSE(LaysOnRelief(*state));
}

TEST_F(HandPlacingTest, AFitThatCannotBeMadeSaysWhy) {
  Tissue changed = Block();
  Edit(*state, "Sphere", "", [](authoring::Document& next) {
    next.surfaces[0] = Share(test::Sphere({0, 0, 0}, 2 * kMm, 3));
  });
  changed.pose.position.z = 0.025;  // some 23 mm from the sphere
  SetTissue(*state, 0, changed, "Move");
  app::Run(*state, "fit-to-relief");
  EXPECT_NE(state->message.find("away from the relief"), std::string::npos) << state->message;
  EXPECT_EQ(Block().pose, changed.pose);
}

}  // namespace
}  // namespace arthro::app

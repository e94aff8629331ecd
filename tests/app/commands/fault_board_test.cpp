// Faults of an imported surface and their mending, without a window.
#include "app/steps/tissue/fault_board.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <thread>

#include <gtest/gtest.h>

#include "app/editor/every_step.h"
#include "app/files/scene_files.h"
#include "app/state/command.h"
#include "app/steps/tissue/tissue_step.h"
#include "authoring/tissue/surface/surface_check.h"
#include "tests/support/shapes.h"

namespace arthro::app {
namespace {

class FaultBoardTest : public testing::Test {
 protected:
  void Begin(SurfaceMesh surface) {
    authoring::Document document = NewDocument();
    document.panorama = Share(ColourImage(64, 48));
    Tissue& tissue = document.scene.tissues.emplace_back();
    tissue.name = "part";
    tissue.mesh = "part.vtu";
    document.surfaces.push_back(Share(std::move(surface)));
    state.reset(new EditorState(MakeEditorState(std::move(document))));
    state->tissue = 0;
    state->step = Step::kTissue;
    state->steps.tissue->page = TissuePage::kMesh;
    Finish();
  }
  void Finish() {
    do {
      FinishWork(*state);
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    } while (state->jobs.busy() || state->steps.tissue->faults->jobs.busy() ||
             !FaultsOfChosen(*state));
  }
  const SurfaceMesh& Surface() const { return *state->document().surfaces[0]; }
  std::unique_ptr<EditorState> state;
};

SurfaceMesh BallWithAHole() {
  SurfaceMesh ball = test::Sphere({0, 0, 0}, 0.01, 3);
  ball.triangles.pop_back();
  return ball;
}

TEST_F(FaultBoardTest, AHoleIsShownAndMendedByOneStep) {
  Begin(BallWithAHole());
  ASSERT_TRUE(ShownFaults(*state));
  EXPECT_TRUE(ShownFaults(*state)->Has(authoring::FaultKind::kHole));
  state->steps.tissue->page = TissuePage::kHold;
  EXPECT_FALSE(ShownFaults(*state)) << "only the Mesh page draws them";
  EXPECT_FALSE(CommandOf(*state, "make-layer").enabled(*state));
  app::Run(*state, "mend-surface");
  Finish();
  EXPECT_TRUE(authoring::CheckSurface(Surface()).IsClosedManifold());
  EXPECT_TRUE(state->document().scene.tissues[0].mesh.empty()) << "made for another surface";
  EXPECT_EQ(state->message, "part: 1 filled hole. Make its tetrahedra anew.");
  EXPECT_FALSE(CommandOf(*state, "mend-surface").enabled(*state));
  app::Run(*state, "undo");
  EXPECT_FALSE(authoring::CheckSurface(Surface()).IsClosedManifold());
}

TEST_F(FaultBoardTest, ASheetBecomesALayerAndATooThickOneIsRefused) {
  SurfaceMesh dome = test::Sphere({0, 0, 0}, 0.01, 3);
  std::erase_if(dome.triangles, [&](const auto& t) {
    return std::any_of(t.begin(), t.end(), [&](int i) { return dome.vertices[i].z < -1e-9; });
  });
  Begin(std::move(dome));
  EXPECT_FALSE(CommandOf(*state, "mend-surface").enabled(*state));
  state->steps.tissue->faults->thickness = 0.02;
  app::Run(*state, "make-layer");
  Finish();
  ASSERT_EQ(state->dialogs.size(), 1u);
  EXPECT_NE(std::get<ErrorDialog>(state->dialogs[0]).sentence.find("run through itself"),
            std::string::npos);
  state->dialogs.clear();
  state->steps.tissue->faults->thickness = 1e-3;
  app::Run(*state, "make-layer");
  Finish();
  EXPECT_TRUE(authoring::CheckSurface(Surface()).IsClosedManifold());
}

}  // namespace
}  // namespace arthro::app

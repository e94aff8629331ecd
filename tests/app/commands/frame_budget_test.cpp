// Costs per frame: what is measured and when, the verdict in words, and the change that helps.
#include "app/steps/budget/frame_budget.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "app/editor/every_step.h"
#include "app/files/scene_files.h"
#include "app/platform/resource_folder.h"
#include "app/steps/depth/depth_step.h"
#include "app/steps/practice/start_practice.h"
#include "app/steps/tissue/tissue_step.h"
#include "authoring/project/document_io.h"
#include "simulation/practice/hands/practice.h"
#include "tests/app/commands/settle.h"
#include "tests/support/temp_folder.h"

namespace arthro::app {
namespace {

using Kind = BudgetChange::Kind;

// A scene with one tissue that has tetrahedra.
Scene SceneWithTissue() {
  Scene scene;
  Tissue& tissue = scene.tissues.emplace_back();
  tissue.name = "meniscus";
  tissue.mesh = "meniscus.vtu";
  return scene;
}

void AddSteps(FrameBudget& budget, int elements, double seconds) {
  TissueCost cost{0, elements};
  for (int i = 0; i < 9; ++i) cost.step.Add(seconds);
  budget.tissues = {cost};
}

FrameCost Frame(double scene, double occlusion, double whole) {
  return {{scene, occlusion, 0, 1e-3}, 0, whole};
}

TEST(RunningMedian, ForgetsWhatIsOld) {
  RunningMedian times;
  EXPECT_EQ(times.median(), 0);
  times.Add(5);
  EXPECT_EQ(times.median(), 5);
  for (int i = 0; i < 200; ++i) times.Add(1);
  EXPECT_EQ(times.median(), 1);
  EXPECT_EQ(times.largest(), 1);
}

TEST(FrameBudget, SaysThatCutsWillLagWhereAStepTakesLongerThanAFrame) {
  FrameBudget budget;
  AddSteps(budget, 600, 21e-3);
  const auto verdicts = VerdictsOf(budget, SceneWithTissue());
  EXPECT_EQ(verdicts[0].words, "The tissue takes 21.0 ms of 16.7: cuts will lag.");
  EXPECT_FALSE(verdicts[1].share) << "no force loop has run";
  EXPECT_FALSE(verdicts[2].share) << "no picture was drawn";
}

TEST(FrameBudget, ProposesTheFinestMeshThatKeepsToTheFrame) {
  const Scene scene = SceneWithTissue();
  FrameBudget budget;
  AddSteps(budget, 600, 21e-3);
  const auto change = HelpfulChange(budget, scene, MovingPicture::kAutomatic);
  ASSERT_TRUE(change);
  EXPECT_EQ(change->kind, Kind::kCoarserTissue);
  EXPECT_EQ(change->size, authoring::MeshSize::kDefault);
  // The measured budgets take 1.9 and 3.8 ms.
  EXPECT_NEAR(change->saving, 21e-3 * (1 - 1.9 / 3.8), 1e-9);
  AddSteps(budget, 600, 60e-3);
  EXPECT_EQ(HelpfulChange(budget, scene, MovingPicture::kAutomatic)->size,
            authoring::MeshSize::kCoarse);
  AddSteps(budget, 150, 60e-3);
  EXPECT_EQ(HelpfulChange(budget, scene, MovingPicture::kAutomatic)->kind, Kind::kRigidTissue)
      << "it is as coarse as a tissue can be";
  AddSteps(budget, 600, 2e-3);
  EXPECT_FALSE(HelpfulChange(budget, scene, MovingPicture::kAutomatic)) << "there is room";
}

TEST(FrameBudget, LeavesOutTheShadeBeforePixels) {
  FrameBudget budget;
  NoteFrame(budget, Frame(20e-3, 12e-3, 36e-3));
  auto change = HelpfulChange(budget, {}, MovingPicture::kAutomatic);
  ASSERT_TRUE(change);
  EXPECT_EQ(change->kind, Kind::kPlainPicture);
  EXPECT_DOUBLE_EQ(change->saving, 12e-3);
  NoteFrame(budget, Frame(60e-3, 2e-3, 80e-3));
  NoteFrame(budget, Frame(60e-3, 2e-3, 80e-3));
  change = HelpfulChange(budget, {}, MovingPicture::kAutomatic);
  ASSERT_TRUE(change);
  EXPECT_EQ(change->kind, Kind::kSmallPicture);
  EXPECT_FALSE(HelpfulChange(budget, {}, MovingPicture::kSmall)) << "there is nothing left to do";
}

TEST(FrameBudget, MissedTicksAreForcesThatTremble) {
  FrameBudget budget;
  simulation::ServoReport report;
  report.period = 1e-3;
  report.ticks = 950;
  report.missed = 50;
  for (int i = 0; i < 100; ++i) report.compute.Add(1e-4);
  NoteForce(budget, report);
  EXPECT_EQ(VerdictsOf(budget, {})[1].words,
            "The force loop leaves out 5.0 % of its ticks: forces will tremble.");
}

class BudgetOfDemo : public testing::Test {
 protected:
  BudgetOfDemo() {
    std::filesystem::copy(ResourceFolder() / "demo", temp / "demo");
    StartDocument(state, authoring::OpenDocument(temp / "demo"), true);
    state.steps.practice->pace = simulation::TissuePace::kInline;
    state.steps.tissue->preset_folder = ResourceFolder() / "presets" / "tissues";
    LoadTissuePresets(state);
    StartPractice(state);
    Settle(state);
  }
  // Leads the tip 2 mm into the tissue, by its vertex that is nearest to the portal.
  void PressOn(int tissue) {
    const Scene& scene = state.document().scene;
    const glm::dvec3 portal(scene.portals.incision_spacing, 0, 0);
    glm::dvec3 nearest(INFINITY);
    for (const glm::dvec3& x : state.document().surfaces.at(tissue)->vertices) {
      const glm::dvec3 in_own_portal = scene.tissues.at(tissue).pose * x - portal;
      if (glm::length(in_own_portal) < glm::length(nearest)) nearest = in_own_portal;
    }
    simulation::RodPose pose;
    pose.depth = glm::length(nearest) + 2e-3;
    pose.latitude = std::atan2(-nearest.y, std::hypot(nearest.x, nearest.z));
    pose.longitude = std::atan2(nearest.x, nearest.z);
    state.practice->instrument().Set(pose);
    for (int frame = 0; frame < 12; ++frame) {
      state.practice->Advance(1.0 / 60);
      FinishWork(state);
    }
  }
  const FrameBudget& Budget() const { return *state.steps.practice->budget; }
  test::TempFolder temp;
  EditorState state = MakeEditorState({});
};

TEST_F(BudgetOfDemo, NothingIsMeasuredWhileItIsClosed) {
  ASSERT_TRUE(state.practice);
  PressOn(0);
  EXPECT_TRUE(Budget().tissues.empty());
  EXPECT_FALSE(Budget().force);
  EXPECT_EQ(Budget().session, nullptr);
}

TEST_F(BudgetOfDemo, APressedTissueIsMeasuredAndRigidInOneStepOfTheHistory) {
  ASSERT_TRUE(state.practice);
  app::Run(state, "budget");
  PressOn(0);
  ASSERT_FALSE(Budget().tissues.empty());
  const TissueCost& cost = Budget().tissues.front();
  EXPECT_GT(cost.elements, 100);
  EXPECT_FALSE(cost.step.empty());
  EXPECT_GT(cost.step.median(), 0);
  EXPECT_TRUE(Budget().force);

  const std::string mesh = state.document().scene.tissues[0].mesh;
  const int position = state.history.Position();
  Make(state, {Kind::kRigidTissue, 0, {}, 0});
  EXPECT_EQ(state.history.Position(), position + 1);
  EXPECT_TRUE(state.document().scene.tissues[0].mesh.empty());
  EXPECT_TRUE(state.practice) << "the practice goes on with the tissue that it has";
  state.history.Undo();
  EXPECT_EQ(state.document().scene.tissues[0].mesh, mesh);
}

}  // namespace
}  // namespace arthro::app

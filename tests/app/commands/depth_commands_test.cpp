// Commands of the backdrop: panorama, depth map, and what becomes of an imported one.
#include <chrono>
#include <fstream>
#include <thread>

#include <gtest/gtest.h>

#include "app/steps/depth/depth_step.h"
#include "app/steps/panorama/panorama_step.h"
#include "tests/app/commands/command_test.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;

TEST_F(Commands, DepthFollowsItsOptionsAndBothAreUndoneAtOnce) {
  OpenAndMakeDepth();
  const auto before = state.document().depth;
  authoring::DepthOptions options = state.document().depth_options;
  options.near_relief = 0.008;
  SetDepthOptions(state, options, "Near relief");
  EXPECT_TRUE(DepthIsUnderWay(state));
  EndDrag(state);
  Settle(state);
  ASSERT_NE(state.document().depth, before);
  const auto after = state.document().depth;
  float nearest = 0;
  for (const float h : after->relief)
    if (h > nearest) nearest = h;
  EXPECT_NEAR(nearest, 0.008, 1e-6) << "the range is filled";

  app::Run(state, "undo");
  EXPECT_EQ(state.document().depth, before);
  EXPECT_FALSE(state.history.CanUndo()) << "one step, though the depth came later";
  app::Run(state, "redo");
  EXPECT_EQ(state.document().depth, after);
  EXPECT_FALSE(DepthIsUnderWay(state)) << "nothing is computed twice";
}

TEST_F(Commands, WhileASliderIsHeldOnlyAPreviewIsMade) {
  OpenAndMakeDepth();
  const auto before = state.document().depth;
  authoring::DepthOptions options = state.document().depth_options;
  state.dragging = true;
  options.near_relief = 0.009;
  SetDepthOptions(state, options, "Near relief");
  for (int i = 0; i < 60000 && !state.steps.depth->cache.preview; ++i) {
    FinishWork(state);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  ASSERT_TRUE(state.steps.depth->cache.preview);
  for (int i = 0; i < 50; ++i) {
    FinishWork(state);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_EQ(state.document().depth, before);
  EndDrag(state);
  Settle(state);
  EXPECT_NE(state.document().depth, before);
}

TEST_F(Commands, OptionsThatContradictEachOtherAreToldAndKeepTheDepth) {
  OpenAndMakeDepth();
  const auto before = state.document().depth;
  authoring::DepthOptions options = state.document().depth_options;
  options.low_percentile = 60;
  options.high_percentile = 40;
  SetDepthOptions(state, options, "Low percentile");
  EndDrag(state);
  Settle(state);
  EXPECT_EQ(state.document().depth, before);
  EXPECT_NE(state.steps.depth->cache.ProblemOf(state.document()), "");
  EXPECT_TRUE(state.dialogs.empty()) << "a slider on its way is no reason for a dialog";
  app::Run(state, "undo");
  EXPECT_EQ(state.steps.depth->cache.ProblemOf(state.document()), "");
}

TEST_F(Commands, SavingWaitsForTheDepthOfTheOptions) {
  OpenAndMakeDepth();
  authoring::DepthOptions options = state.document().depth_options;
  options.near_relief = 0.004;
  SetDepthOptions(state, options, "Near relief");
  app::Run(state, "save");
  Settle(state);
  ASSERT_TRUE(state.history.IsSaved());
  const LoadedScene saved = LoadScene(temp / "knee");
  float nearest = 0;
  for (const float h : saved.depth->relief)
    if (h > nearest) nearest = h;
  EXPECT_NEAR(nearest, 0.004, 1e-6);
}

TEST_F(Commands, AnImportedDepthMapIsReplacedOnlyWhenThatIsAskedForAndIsUndone) {
  Open();
  const auto imported = state.document().depth;
  ASSERT_TRUE(state.document().is_depth_imported);
  authoring::DepthOptions options = state.document().depth_options;
  options.near_relief = 0.008;
  SetDepthOptions(state, options, "Near relief");
  EndDrag(state);
  Settle(state);
  EXPECT_EQ(state.document().depth, imported);
  EXPECT_FALSE(state.history.CanUndo());
  EXPECT_NE(state.message.find("imported depth map is kept"), std::string::npos);

  app::Run(state, "make-depth");
  Settle(state);
  EXPECT_NE(state.document().depth, imported);
  app::Run(state, "undo");
  EXPECT_EQ(state.document().depth, imported);
  EXPECT_FALSE(state.history.CanUndo()) << "one step";
  app::Run(state, "redo");
  Settle(state);
  SetDepthOptions(state, options, "Near relief");
  Settle(state);
  app::Run(state, "undo");
  app::Run(state, "undo");
  EXPECT_EQ(state.document().depth, imported);
}

TEST_F(Commands, AnotherDepthMapDropsTheErrorAndTheOriginsOfTheImportedOne) {
  Open();
  const auto sigma = Share(DepthMap(400, 300, 0.0005f));
  Edit(state, "Measure", "", [&](authoring::Document& next) {
    next.depth_sigma = sigma;
    next.depth_origin = Share(OriginMap(400, 300, ReliefOrigin::kMeasured));
  });
  SetTitle(state, "Other");
  EXPECT_EQ(state.document().depth_sigma, sigma);
  app::Run(state, "make-depth");
  Settle(state);
  ASSERT_TRUE(state.document().depth_sigma) << "a depth map from brightness states its own";
  EXPECT_NE(state.document().depth_sigma, sigma);
  EXPECT_FALSE(state.document().depth_origin);
  app::Run(state, "undo");
  EXPECT_EQ(state.document().depth_sigma, sigma);
  EXPECT_TRUE(state.document().depth_origin);
  WriteColourImage(temp / "other.png", test::KneePicture(200, 100));
  ImportPanorama(state, temp / "other.png");
  Settle(state);
  ASSERT_TRUE(state.document().depth_sigma);
  EXPECT_EQ(state.document().depth_sigma->width, 200);
}

TEST_F(Commands, AnImportedDepthMapStaysImportedInASavedScene) {
  Open();
  SetTitle(state, "Other");
  app::Run(state, "save");
  Settle(state);
  OpenScene(state, temp / "knee");
  Settle(state);
  EXPECT_TRUE(state.document().is_depth_imported);
  // One that a person puts in the place of a made one is imported as well.
  app::Run(state, "make-depth");
  Settle(state);
  app::Run(state, "save");
  Settle(state);
  const fs::path map = temp / "knee" / state.document().scene.backdrop.depth;
  WriteDepthMap(map, DepthMap(400, 300, 0.002f));
  OpenScene(state, temp / "knee");
  Settle(state);
  EXPECT_TRUE(state.document().is_depth_imported);
}

TEST_F(Commands, AnotherPictureOfTheSameSizeKeepsAnImportedDepthMap) {
  Open();
  const auto imported = state.document().depth;
  WriteColourImage(temp / "same.png", test::KneePicture(400, 300, 5.0));
  ImportPanorama(state, temp / "same.png");
  Settle(state);
  EXPECT_EQ(state.document().depth, imported);
  WriteColourImage(temp / "other.png", test::KneePicture(200, 100));
  ImportPanorama(state, temp / "other.png");
  Settle(state);
  EXPECT_EQ(state.document().depth->width, 200);
  app::Run(state, "undo");
  EXPECT_EQ(state.document().depth, imported);
}

TEST_F(Commands, APanoramaBecomesTheBackdropWithADepthMapOfItsOwn) {
  WriteColourImage(temp / "new.png", test::KneePicture(200, 100));
  ImportPanorama(state, temp / "new.png");
  Settle(state);
  ASSERT_TRUE(state.document().panorama);
  EXPECT_EQ(state.document().panorama->width, 200);
  ASSERT_TRUE(state.document().depth);
  EXPECT_EQ(state.document().depth->width, 200);
  EXPECT_FALSE(state.history.IsSaved());
}

TEST_F(Commands, AReportOfAnotherPanoramaIsRefused) {
  Open();
  std::ofstream(temp / "r.json")
      << R"({"panorama":{"width":800,"height":300,"focal_px":500,"cx":1,"cy":2}})";
  EXPECT_THROW(ReadPanoramaReport(state, temp / "r.json"), Error);
  std::ofstream(temp / "r.json")
      << R"({"panorama":{"width":400,"height":300,"focal_px":500,"cx":1,"cy":2}})";
  ReadPanoramaReport(state, temp / "r.json");
  EXPECT_DOUBLE_EQ(state.document().scene.backdrop.projection.focal_px, 500);
}

}  // namespace
}  // namespace arthro::app

// Relief measured from footage in the command layer, without a window. The measurements here are
// made up; what the real one finds is tested with authoring/relief.
#include "app/steps/panorama/board/relief_run.h"

#include <atomic>
#include <chrono>
#include <limits>
#include <thread>

#include <gtest/gtest.h>

#include "app/editor/every_step.h"
#include "app/files/scene_files.h"
#include "app/state/command.h"
#include "app/steps/depth/depth_step.h"
#include "app/steps/panorama/board/footage_words.h"
#include "app/steps/panorama/board/motion_plan.h"
#include "app/steps/panorama/board/panorama_run.h"
#include "app/steps/panorama/footage_work.h"
#include "simulation/scene/image_io.h"
#include "tests/app/commands/settle.h"
#include "tests/support/temp_folder.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;
using authoring::ReliefObserver;
using authoring::ReliefRequest;
using authoring::ReliefResult;

constexpr int kRunFrames = 4, kScale = 2;

// A relief of 10 x 8 cells under a picture of twice the size; frame 2 has no pose.
ReliefResult MadeUpRelief(const ReliefRequest& request, const Progress& progress,
                          const ReliefObserver& observer) {
  ReliefResult result;
  for (int i = 0; i < kRunFrames; ++i) {
    progress.Step("finding poses", static_cast<double>(i) / kRunFrames);
    authoring::PosedFrame frame;
    frame.index = i;
    frame.is_posed = i != 2 && !request.excluded.contains(i);
    frame.reason = frame.is_posed ? "" : "its 90 points do not agree with the other frames";
    frame.tracks = 90;
    frame.rms_px = 0.4;
    frame.sigma_m = 1e-4;
    result.report.frames.push_back(frame);
  }
  authoring::ReliefSoFar so_far;
  so_far.cameras = {{{0, 0, 0.01}, {0, 0, 1}}, {{0.001, 0, 0.01}, {0, 0, 1}}};
  so_far.points = {{-0.01, 0, 0.04}, {0.01, 0, 0.04}, {0, 0.01, 0.03}};
  if (observer) observer(so_far);
  result.relief = DepthMap(10, 8, 0.002f);
  result.sigma = DepthMap(10, 8, 1e-4f);
  result.confidence = DepthMap(10, 8, 0.9f);
  result.origin = OriginMap(10, 8, ReliefOrigin::kMeasured);
  result.origin.at(0, 0) = ReliefOrigin::kBrightness;
  result.picture = {10 * kScale, 8 * kScale,
                    std::vector<std::uint8_t>(80 * 4 * kScale * kScale, 200)};
  result.picture_scale = kScale;
  result.report.projection = {ProjectionType::kEquirectangular, {4.5, 3.5}, 1000, 2};
  result.report.width = 10, result.report.height = 8;
  result.report.radius = 0.045;
  result.report.coverage = 0.87;
  result.report.points = 812;
  result.report.rms_px = 0.42;
  result.report.median_insertion = 0.018;
  return result;
}

ReliefResult Refused(const ReliefRequest& request, const Progress& progress,
                     const ReliefObserver& observer) {
  ReliefResult result = MadeUpRelief(request, progress, observer);
  result.report.verdict = {"pieces", "only 40 % of the frames join into one reconstruction",
                           "share of frames with a pose", 0.4, 0.5};
  return result;
}

authoring::PanoramaResult MadeUpPanorama(authoring::PanoramaSession&,
                                         const authoring::PanoramaRequest&,
                                         const authoring::PanoramaObserver&, const Progress&) {
  authoring::PanoramaResult result;
  for (int i = 0; i < kRunFrames; ++i) {
    authoring::FrameReport row;
    row.index = i;
    row.is_usable = row.is_placed = true;
    result.report.frames.push_back(row);
  }
  result.picture = {64, 48, std::vector<std::uint8_t>(64 * 48 * 4, 200)};
  result.report.panorama = {64, 48, 55.0, 31.0, 23.0};
  return result;
}

class ReliefRun : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directory(clip);
    ColourImage frame(40, 30);
    for (int i = 0; i < kRunFrames; ++i)
      WriteColourImage(clip / ("frame" + std::to_string(i) + ".png"), frame);
    state.steps.panorama->makers->run = MadeUpPanorama;
    Measure(MadeUpRelief);
    OpenFootage(state, clip);
    Settle();
    Lens lens;
    lens.width = 40, lens.height = 30;
    lens.focal_px = 30, lens.cx = 19.5, lens.cy = 14.5;
    lens.field_of_view = 0.8;
    lens.circle = {19.5, 14.5, 11.9};
    board().lenses.push_back({"scope", "", lens});
    SetFootageLens(state, 1);
    Settle();
  }
  FootageBoard& board() { return *state.steps.panorama->footage; }
  void Measure(ReliefMaker maker) {
    state.steps.panorama->makers->relief = [this, maker](const ReliefRequest& request,
                                                         const Progress& progress,
                                                         const ReliefObserver& observer) {
      ++measured;
      angle = request.options.view_angle;
      return maker(request, progress, observer);
    };
  }
  void Settle() { app::Settle(state); }
  void RunIt() {
    app::Run(state, "run-footage");
    Settle();
  }

  test::TempFolder temp;
  fs::path clip = temp / "clip";
  std::atomic<int> measured{0};
  std::atomic<double> angle{0};
  EditorState state = MakeEditorState(NewDocument());
};

TEST_F(ReliefRun, MeasuresByItselfWhereTheLensIsKnown) {
  RunIt();
  EXPECT_EQ(measured, 1);
  EXPECT_EQ(angle, state.document().scene.scope.view_angle) << "the scope's own";
  ASSERT_TRUE(board().made);
  EXPECT_TRUE(board().made->is_measured());
  EXPECT_EQ(WordsOfResult(board()).front(), "Relief measured over 87 % of the tissue in view");
  EXPECT_EQ(WordsOfFrame(board(), 0),
            "Its camera pose was found to ±0.10 mm; its points fit to 0.4 px");
  EXPECT_EQ(StatusOf(board(), 2), FrameStatus::kRejected);
  EXPECT_NE(WordsOfFrame(board(), 2).find("do not agree"), std::string::npos);
  ASSERT_TRUE(board().motion) << "poses were shown";
  EXPECT_EQ(board().motion->cameras.size(), 2u);
  ASSERT_TRUE(board().mosaic);
  EXPECT_EQ(board().mosaic->width, 10 * kScale);
  EXPECT_EQ(WordsOfNextRun(board()), "Nothing changed since the last run.");
  EXPECT_FALSE(CanRun(state));
}

TEST_F(ReliefRun, ReliefUncertaintyAndOriginBecomeTheBackdropInOneStep) {
  RunIt();
  const int steps = state.history.Position();
  app::Run(state, "use-panorama");
  EXPECT_EQ(state.history.Position(), steps + 1);
  EXPECT_EQ(state.step, Step::kDepth);
  EXPECT_TRUE(ShowsDepthBoard(state));
  const authoring::Document& document = state.document();
  ASSERT_TRUE(document.depth && document.depth_sigma && document.depth_origin);
  EXPECT_EQ(document.panorama->width, 10 * kScale);
  EXPECT_EQ(document.depth->width, 10 * kScale);
  EXPECT_EQ(document.depth_sigma->height, 8 * kScale);
  EXPECT_EQ(document.depth_origin->at(1, 1), ReliefOrigin::kBrightness);
  EXPECT_EQ(document.depth_origin->at(2, 2), ReliefOrigin::kMeasured);
  EXPECT_EQ(document.scene.backdrop.radius, 0.045);
  EXPECT_EQ(document.scene.backdrop.projection.px_per_deg, 2.0 * kScale);
  // Pixel (i, j) of the enlarged picture lies at ((i + 0.5) / 2 - 0.5) of the map.
  EXPECT_EQ(document.scene.backdrop.projection.centre_px, glm::dvec2(9.5, 7.5));
  EXPECT_TRUE(document.lens);
  Settle();
  EXPECT_EQ(state.history.Position(), steps + 1) << "no depth is made from brightness";
  app::Run(state, "use-panorama");
  EXPECT_EQ(state.history.Position(), steps + 1) << "it is the backdrop already";
  app::Run(state, "undo");
  EXPECT_FALSE(state.document().panorama);
  EXPECT_FALSE(state.document().depth_origin);
}

TEST_F(ReliefRun, TheSceneOfAJobHasTheBackdropOfTheWindow) {
  RunIt();
  app::Run(state, "use-panorama");
  const authoring::Document& window = state.document();
  const authoring::Document job =
      DocumentFromRelief(MadeUpRelief({}, {}, {}), board().lenses.back().lens, 0.5);
  EXPECT_EQ(job.panorama->rgb, window.panorama->rgb);
  EXPECT_EQ(job.depth->relief, window.depth->relief);
  EXPECT_EQ(job.depth_sigma->relief, window.depth_sigma->relief);
  EXPECT_EQ(job.depth_origin->origin, window.depth_origin->origin);
  EXPECT_EQ(job.scene.backdrop.radius, window.scene.backdrop.radius);
  EXPECT_EQ(job.scene.backdrop.projection, window.scene.backdrop.projection);
  EXPECT_EQ(job.scene.scope.lens, window.scene.scope.lens);
  EXPECT_TRUE(job.is_depth_imported && window.is_depth_imported);
}

TEST_F(ReliefRun, AClipThatDoesNotDetermineDepthIsPlacedAsUsualAndSaysWhy) {
  Measure(Refused);
  RunIt();
  ASSERT_TRUE(board().made);
  EXPECT_FALSE(board().made->is_measured());
  EXPECT_EQ(WordsOfResult(board()).front(), "4 of 4 frames placed");
  ASSERT_TRUE(board().made->relief);
  EXPECT_EQ(WordsOfRelief(*board().made->relief).front(),
            "The relief was not measured: only 40 % of the frames join into one reconstruction.");
  EXPECT_EQ(WordsOfTest(board().made->relief->report.verdict),
            "Share of frames with a pose: 0.4, limit 0.5");
  app::Run(state, "use-panorama");
  Settle();
  EXPECT_EQ(state.document().panorama->width, 64);
  EXPECT_FALSE(state.document().is_depth_imported);
  EXPECT_FALSE(HasMeasuredDepth(state.document()));
}

TEST_F(ReliefRun, ThePartThatWasMeasuredIsThereWhereTheAuthorWantsIt) {
  Measure(Refused);
  RunIt();
  ASSERT_TRUE(CommandOf(state, "use-measured-part").enabled(state));
  app::Run(state, "use-measured-part");
  EXPECT_EQ(state.document().panorama->width, 10 * kScale);
  EXPECT_TRUE(HasMeasuredDepth(state.document()));
  app::Run(state, "undo");
  EXPECT_FALSE(state.document().panorama);
}

TEST_F(ReliefRun, IsNotRepeatedForTheSameClipLensAndFrames) {
  Measure(Refused);
  RunIt();
  authoring::PanoramaOptions options = *board().options;
  options.compose.even_light = !options.compose.even_light;
  SetPanoramaOptions(state, options);
  board().next_stage = "compose";  // the made-up run keeps no products
  RunIt();
  EXPECT_EQ(measured, 1);
  SetFrameIncluded(state, 3, false);
  EXPECT_EQ(board().next_stage, "measure");
  RunIt();
  EXPECT_EQ(measured, 2);
}

TEST_F(ReliefRun, IsLeftOutWhereTheAuthorChoosesSo) {
  app::Run(state, "measure-relief");
  EXPECT_FALSE(board().measures_relief);
  RunIt();
  EXPECT_EQ(measured, 0);
  EXPECT_FALSE(board().made->relief);
  app::Run(state, "measure-relief");
  EXPECT_EQ(WordsOfNextRun(board()),
            "The next run measures the relief from the motion of the scope.");
  SetFootageLens(state, 0);
  EXPECT_NE(board().next_stage, "measure") << "without a lens nothing can be measured";
}

TEST_F(ReliefRun, AFaultOfTheMeasurementIsAVerdictAndThePanoramaIsMade) {
  Measure([](const ReliefRequest&, const Progress&, const ReliefObserver&) -> ReliefResult {
    throw Error(Code::kBadImage, "1 of its 4 frames can be used; choose other footage", "clip");
  });
  RunIt();
  ASSERT_TRUE(board().made);
  EXPECT_EQ(WordsOfRelief(*board().made->relief).front(),
            "The relief was not measured: 1 of its 4 frames can be used; choose other footage.");
  EXPECT_FALSE(HasMeasuredPart(state));
  EXPECT_TRUE(state.dialogs.empty());
}

TEST_F(ReliefRun, StopEndsItAndKeepsWhatWasMade) {
  RunIt();
  const auto made = board().made;
  Measure(
      [](const ReliefRequest&, const Progress& progress, const ReliefObserver&) -> ReliefResult {
        for (;;) {
          progress.Step("following points", 0.3);
          std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
      });
  SetFrameIncluded(state, 0, false);
  app::Run(state, "run-footage");
  for (int i = 0; i < 24000 && state.jobs.stage().empty(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_EQ(WordsOfStage(state.jobs.stage()), "Measuring the relief: following points");
  state.jobs.Stop();
  Settle();
  EXPECT_EQ(state.message, "Stopped.");
  EXPECT_TRUE(state.dialogs.empty());
  EXPECT_EQ(board().made, made);
}

TEST(MotionPlan, LaysCamerasAndPointsIntoOneSquare) {
  authoring::ReliefSoFar so_far;
  so_far.cameras = {{{0, 0, 0.01}, {0, 0, 1}}};
  so_far.points = {{-0.02, 0, 0.03}, {0.02, 0.01, 0.03}};
  so_far.is_in_portal_frame = true;
  const MotionPlan above = PlanOf(so_far, PlanSide::kAbove);
  ASSERT_EQ(above.points.size(), 2u);
  EXPECT_NEAR(above.points[0].x, -0.92, 1e-9) << "left is left";
  ASSERT_TRUE(above.portal);
  EXPECT_GT(above.portal->y, above.cameras[0].tip.y) << "ahead is up";
  EXPECT_LT(above.cameras[0].ahead.y, 0);
  const MotionPlan side = PlanOf(so_far, PlanSide::kSide);
  EXPECT_GT(side.points[1].y, side.points[0].y) << "down is down";
  EXPECT_TRUE(PlanOf({}, PlanSide::kAbove).points.empty());
}

}  // namespace
}  // namespace arthro::app

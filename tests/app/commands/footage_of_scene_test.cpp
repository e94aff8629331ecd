// The footage board of a scene that is saved, closed and opened again, and mending by hand on it.
// The runs are made up.
#include <chrono>
#include <thread>

#include <gtest/gtest.h>

#include "app/editor/every_step.h"
#include "app/files/scene_files.h"
#include "app/state/command.h"
#include "app/steps/depth/depth_step.h"
#include "app/steps/panorama/board/panorama_run.h"
#include "app/steps/panorama/footage_work.h"
#include "app/steps/panorama/panorama_step.h"
#include "authoring/panorama/report_io.h"
#include "authoring/project/document_io.h"
#include "simulation/scene/files/scene_io.h"
#include "simulation/scene/image_io.h"
#include "tests/support/temp_folder.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;
using authoring::FrameReport;

constexpr int kClipFrames = 5, kClipWidth = 40, kClipHeight = 30;

// Frames of one size in a row, 10 px apart; frame 3 is not placed unless it is tied.
authoring::PanoramaResult MadeUpRun(authoring::PanoramaSession&,
                                    const authoring::PanoramaRequest& request,
                                    const authoring::PanoramaObserver&, const Progress&) {
  authoring::PanoramaResult result;
  authoring::PanoramaReport& report = result.report;
  report.lens.model = LensModel::kPinhole;
  report.lens.width = kClipWidth, report.lens.height = kClipHeight;
  report.lens.cx = 20, report.lens.cy = 15, report.lens.focal_px = 30;
  report.lens.field_of_view = 1.2;
  report.is_lens_guessed = true;
  report.rectified = {kClipWidth, kClipHeight, 30, 20, 15};
  report.panorama = {80, 30, 30, 40, 15};
  report.summary = "partial";
  report.detector = "direct";
  report.options = "{}";
  report.text_boxes = {{2, 3, 8, 4}};
  for (int i = 0; i < kClipFrames; ++i) {
    FrameReport& row = report.frames.emplace_back();
    row.index = i;
    row.source = "frame" + std::to_string(i) + ".png";
    row.is_usable = true;
    row.is_placed = i != 3 && !request.excluded.contains(i);
    row.component = row.is_placed ? 0 : -1;
    row.reason = row.is_placed ? "" : "agrees with no other frame";
    row.panorama_from_rectified = {1, 0, 10.0 * i, 0, 1, 0, 0, 0, 1};
  }
  if (!request.ties.empty())
    report.tied = {{3, static_cast<int>(request.ties.size()), 0, 2, false}};
  result.picture = {80, 30, std::vector<std::uint8_t>(80 * 30 * 4, 200)};
  return result;
}

class FootageOfScene : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directory(temp / "clip");
    for (int i = 0; i < kClipFrames; ++i) {
      ColourImage image(kClipWidth, kClipHeight);
      for (std::uint8_t& value : image.rgb) value = static_cast<std::uint8_t>(40 * i + 20);
      WriteColourImage(temp / "clip" / ("frame" + std::to_string(i) + ".png"), image);
    }
  }

  static void Settle(EditorState& state) {
    const auto limit = std::chrono::steady_clock::now() + std::chrono::minutes(10);
    do {
      FinishWork(state);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      ASSERT_LT(std::chrono::steady_clock::now(), limit) << "work does not end";
    } while (state.jobs.busy() || state.steps.depth->preview_jobs.busy() ||
             state.steps.panorama->frame_jobs.busy());
    FinishWork(state);
  }

  // A scene of the clip in temp/scene, with frame 1 left out.
  void MakeScene() {
    EditorState state = MakeEditorState(NewDocument());
    state.steps.panorama->makers->run = MadeUpRun;
    OpenFootage(state, temp / "clip");
    Settle(state);
    SetFrameIncluded(state, 1, false);
    RunFootage(state);
    Settle(state);
    UseMadePanorama(state);
    Settle(state);
    ASSERT_TRUE(state.document().footage);
    authoring::SaveDocument(state.document(), temp / "scene");
  }
  fs::path scene() const { return temp / "scene"; }
  static void Begin(EditorState& state) {
    state.steps.panorama->makers->run = MadeUpRun;
    FinishWork(state);
  }
  static FootageBoard& BoardOf(EditorState& state) { return *state.steps.panorama->footage; }

  test::TempFolder temp;
};

// Colours fade to nothing at the border of a mosaic, not to black: darkness would count as depth.
TEST_F(FootageOfScene, HasThePanoramaThatTheJobWrites) {
  MakeScene();
  authoring::PanoramaSession session;
  authoring::WritePanorama(temp / "job.png", MadeUpRun(session, {}, {}, {}).picture);
  const ColourImage of_job = ReadColourImage(temp / "job.png");
  EXPECT_EQ(authoring::OpenDocument(scene()).panorama->rgb, of_job.rgb);
  EXPECT_EQ(of_job.at(5, 5)[0], 200);
}

TEST_F(FootageOfScene, AReopenedSceneHasItsBoardReportAndChoice) {
  MakeScene();
  EditorState state = MakeEditorState(authoring::OpenDocument(scene()));
  Begin(state);
  ASSERT_TRUE(state.steps.panorama->footage);
  EXPECT_FALSE(ShowsFootage(state)) << "the scene comes first";
  const FootageBoard& board = BoardOf(state);
  EXPECT_EQ(board.frames(), kClipFrames);
  EXPECT_EQ(board.name, "clip");
  EXPECT_EQ(board.missing, "");
  EXPECT_EQ(board.excluded, (std::set<int>{1}));
  EXPECT_EQ(StatusOf(board, 0), FrameStatus::kPlaced);
  EXPECT_EQ(StatusOf(board, 1), FrameStatus::kExcluded);
  EXPECT_EQ(StatusOf(board, 3), FrameStatus::kRejected);
  EXPECT_EQ(board.notes[3].reason, "agrees with no other frame");
  // The frames are read when they are wanted.
  state.steps.panorama->shows_footage = true;
  Settle(state);
  for (const SharedPicture& thumb : board.thumbs) EXPECT_TRUE(thumb);
}

TEST_F(FootageOfScene, LeavingAFrameOutTomorrowIsAStepThatIsUndoneAndSaved) {
  MakeScene();
  EditorState state = MakeEditorState(authoring::OpenDocument(scene()));
  Begin(state);
  SetFrameIncluded(state, 4, false);
  EXPECT_EQ(state.history.StepName(), "Leave out frame 4");
  EXPECT_EQ(state.document().footage->left_out, (std::vector<double>{1, 4}));
  ASSERT_TRUE(CanRun(state));
  RunFootage(state);
  Settle(state);
  UseMadePanorama(state);
  EXPECT_EQ(state.document().footage->left_out, (std::vector<double>{1, 4}));
  Settle(state);
  state.history.Undo();
  state.history.Undo();
  FinishWork(state);
  EXPECT_EQ(BoardOf(state).excluded, (std::set<int>{1}));
  state.history.Redo();
  FinishWork(state);
  EXPECT_EQ(BoardOf(state).excluded, (std::set<int>{1, 4}));
}

TEST_F(FootageOfScene, AClipThatIsGoneIsOneSentenceAndIsFoundAnew) {
  MakeScene();
  fs::rename(temp / "clip", temp / "elsewhere");
  EditorState state = MakeEditorState(authoring::OpenDocument(scene()));
  Begin(state);
  EXPECT_NE(BoardOf(state).missing.find("is no longer at"), std::string::npos);
  EXPECT_FALSE(CanRun(state));
  state.steps.panorama->shows_footage = true;
  Settle(state);
  // Another clip is refused; the right one is known by its content.
  fs::create_directory(temp / "other");
  WriteColourImage(temp / "other/a.png", ColourImage(kClipWidth, kClipHeight));
  WriteColourImage(temp / "other/b.png", ColourImage(kClipWidth, kClipHeight));
  FindFootage(state, temp / "other");
  Settle(state);
  EXPECT_NE(BoardOf(state).missing.find("not the clip"), std::string::npos);
  EXPECT_FALSE(CanRun(state));
  FindFootage(state, temp / "elsewhere");
  Settle(state);
  EXPECT_EQ(BoardOf(state).missing, "");
  EXPECT_TRUE(CanRun(state));
  EXPECT_EQ(state.document().footage->clips[0].name, "elsewhere");
}

TEST_F(FootageOfScene, TiesAndMasksAreStepsAndReachTheRun) {
  MakeScene();
  EditorState state = MakeEditorState(authoring::OpenDocument(scene()));
  Begin(state);
  FootageBoard& board = BoardOf(state);
  state.steps.panorama->shows_footage = true;
  Settle(state);
  SelectFrame(state, 3);
  AddTie(state, {12, 8}, {25.0, 9.0});
  ASSERT_EQ(board.ties.size(), 1u);
  // Frame 0 lies at 0 and frame 2 at 20 px; x = 25 is nearest to the middle (20, 15) of frame 0.
  EXPECT_EQ(board.ties[0].other->frame, 0);
  EXPECT_NEAR(board.ties[0].other->pixel.x, 25, 1e-9);
  EXPECT_EQ(state.document().footage->ties, board.ties);
  AddMask(state, {4, 4}, {11, 9});
  EXPECT_EQ(board.masked.back(), (authoring::PixelBox{4, 4, 8, 6}));
  ProposeMasks(state);
  EXPECT_EQ(board.masked.size(), 2u);
  ProposeMasks(state);
  EXPECT_EQ(board.masked.size(), 2u) << "not twice";
  const authoring::PanoramaRequest request = RequestOf(board);
  EXPECT_EQ(request.ties.size(), 1u);
  EXPECT_EQ(request.masked.size(), 2u);
  state.history.Undo();
  state.history.Undo();
  state.history.Undo();
  FinishWork(state);
  EXPECT_TRUE(board.ties.empty());
  EXPECT_TRUE(board.masked.empty());
  EXPECT_THROW(AddTie(state, {12, 8}, {400.0, 9.0}), Error) << "beyond the panorama";
}

TEST_F(FootageOfScene, ANewSceneHasNoBoardOfTheOldOne) {
  MakeScene();
  EditorState state = MakeEditorState(authoring::OpenDocument(scene()));
  Begin(state);
  ASSERT_TRUE(state.steps.panorama->footage);
  ++state.document_number;
  state.history = authoring::History(NewDocument());
  FinishWork(state);
  EXPECT_FALSE(state.steps.panorama->footage);
}

TEST_F(FootageOfScene, AnotherPictureHasNoRecord) {
  MakeScene();
  EditorState state = MakeEditorState(authoring::OpenDocument(scene()));
  Begin(state);
  WriteColourImage(temp / "other.png", ColourImage(kClipWidth, kClipHeight));
  ImportPanorama(state, temp / "other.png");
  Settle(state);
  EXPECT_FALSE(state.document().footage);
  EXPECT_TRUE(state.document().scene.backdrop.footage.empty());
}

}  // namespace
}  // namespace arthro::app

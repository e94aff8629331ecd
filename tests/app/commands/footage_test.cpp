// Footage in the command layer, without a window: the clip on the board, a run that tells, ends,
// fails or is stopped, and its result as the backdrop. The runs here are made up; what the real one
// finds is tested with authoring/panorama.
#include <chrono>
#include <cmath>
#include <fstream>
#include <mutex>
#include <thread>

#include <gtest/gtest.h>

#include "app/editor/every_step.h"
#include "app/files/scene_files.h"
#include "app/state/command.h"
#include "app/state/footage/footage_optics.h"
#include "app/steps/depth/depth_step.h"
#include "app/steps/panorama/board/footage_words.h"
#include "app/steps/panorama/board/panorama_run.h"
#include "app/steps/panorama/footage_work.h"
#include "app/steps/panorama/panorama_step.h"
#include "app/steps/portals/portals_step.h"
#include "app/steps/practice/practice_step.h"
#include "authoring/project/document_io.h"
#include "simulation/core/units.h"
#include "simulation/scene/files/scene_io.h"
#include "simulation/scene/image_io.h"
#include "simulation/scene/json/lens_io.h"
#include "tests/app/commands/settle.h"
#include "tests/support/build_paths.h"
#include "tests/support/small_scene.h"
#include "tests/support/temp_folder.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;
using authoring::FrameReport;
using authoring::PanoramaObserver;
using authoring::PanoramaRequest;
using authoring::PanoramaResult;
using authoring::PanoramaSession;

constexpr int kFrames = 6, kWidth = 40, kHeight = 30;

// A picture of one colour that says which it is.
ColourImage Plain(int width, int height, std::uint8_t red) {
  ColourImage image(width, height);
  for (std::size_t i = 0; i < image.rgb.size(); i += 3)
    image.rgb[i] = red, image.rgb[i + 1] = 90, image.rgb[i + 2] = 80;
  return image;
}

FrameReport RowOf(int index, bool is_placed, const std::string& reason, int component) {
  FrameReport row;
  row.index = index;
  row.is_usable = true;
  row.is_placed = is_placed;
  row.reason = reason;
  row.component = component;
  row.rms_px = 0.5, row.expected_error_px = 1.0;
  return row;
}

// Frame 3 is rejected, frame 5 a piece of its own, what is left out stays out, the rest is placed.
PanoramaResult MadeUpRun(PanoramaSession&, const PanoramaRequest& request,
                         const PanoramaObserver& observer, const Progress& progress) {
  PanoramaResult result;
  for (int i = 0; i < kFrames; ++i) {
    progress.Step("match", static_cast<double>(i) / kFrames);
    FrameReport row = RowOf(i, true, "", 0);
    if (i == 3) row = RowOf(i, false, "too few matches", -1);
    if (i == 5) row = RowOf(i, false, "it belongs to piece 2", 1);
    if (request.excluded.contains(i)) row = RowOf(i, false, "left out by hand", -1);
    observer.frame(row, {});
    result.report.frames.push_back(row);
  }
  result.picture = {64, 48, std::vector<std::uint8_t>(64 * 48 * 4, 200)};
  observer.mosaic(result.picture);
  result.report.panorama = {64, 48, 55.0, 31.0, 23.0};
  result.report.mean_error_px = 1.0, result.report.max_error_px = 1.5;
  result.report.drift_px = 0.25;
  result.report.is_partial = true;
  result.report.summary = "partial: 4 of 6 usable frames are in the panorama";
  result.report.warnings = {"the clip is short"};
  return result;
}

class Footage : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directory(clip);
    for (int i = 0; i < kFrames; ++i)
      WriteColourImage(clip / ("frame" + std::to_string(i) + ".png"),
                       Plain(kWidth, kHeight, static_cast<std::uint8_t>(40 * i)));
    state.steps.panorama->makers->run = MadeUpRun;
  }

  void Settle() { app::Settle(state); }
  void OpenClip() {
    OpenFootage(state, clip);
    Settle();
    ASSERT_TRUE(state.steps.panorama->footage);
  }
  void RunIt() {
    app::Run(state, "run-footage");
    Settle();
  }

  test::TempFolder temp;
  fs::path clip = temp / "clip";
  EditorState state = MakeEditorState(NewDocument());
};

TEST_F(Footage, AFolderOfPicturesComesOnTheBoardFrameByFrame) {
  OpenClip();
  const FootageBoard& board = *state.steps.panorama->footage;
  EXPECT_TRUE(ShowsFootage(state));
  ASSERT_EQ(board.frames(), kFrames);
  for (int i = 0; i < kFrames; ++i) {
    ASSERT_TRUE(board.thumbs[static_cast<std::size_t>(i)]) << i;
    EXPECT_EQ(board.thumbs[static_cast<std::size_t>(i)]->at(3, 3)[0], 40 * i);
    EXPECT_EQ(StatusOf(board, i), FrameStatus::kNotYet);
  }
  EXPECT_EQ(WordsOfClip(board), "6 frames · 40 × 30 px");
  EXPECT_TRUE(WordsOfResult(board).empty());
}

// The board was closed with that of the document before, so a script's line did nothing.
TEST_F(Footage, ANewSceneFromAClipByNameShowsItsBoard) {
  OpenScene(state, test::WriteSmallScene(temp / "knee"));
  Settle();
  EXPECT_EQ(RunByName(state, "new-from-footage", {clip.string()}), "");
  Settle();
  EXPECT_TRUE(ShowsFootage(state));
  ASSERT_TRUE(state.steps.panorama->footage);
  EXPECT_EQ(state.steps.panorama->footage->frames(), kFrames);
  EXPECT_EQ(state.document().panorama, nullptr);
}

TEST_F(Footage, OnePictureOfAFolderStandsForAllOfThem) {
  OpenFootage(state, clip / "frame2.png");
  Settle();
  ASSERT_TRUE(state.steps.panorama->footage);
  EXPECT_EQ(state.steps.panorama->footage->frames(), kFrames);
}

TEST_F(Footage, WhatIsDroppedIsKnownByItsName) {
  EXPECT_TRUE(LooksLikeFootage(clip));
  EXPECT_TRUE(LooksLikeFootage("knee.MP4"));
  EXPECT_FALSE(LooksLikeFootage("knee.png")) << "a panorama";
  EXPECT_FALSE(LooksLikeFootage(temp.path())) << "no pictures in it";
  std::ofstream(clip / "scene.json") << "{}";
  EXPECT_FALSE(LooksLikeFootage(clip)) << "a scene with its panorama";
}

TEST_F(Footage, AClipThatCannotBeOpenedIsOneSentenceAndTheBoardStays) {
  OpenClip();
  std::ofstream(temp / "broken.mp4") << "no video";
  OpenFootage(state, temp / "broken.mp4");
  Settle();
  ASSERT_EQ(state.dialogs.size(), 1u);
  EXPECT_NE(std::get<ErrorDialog>(state.dialogs[0]).sentence.find("broken.mp4"), std::string::npos);
  EXPECT_EQ(state.steps.panorama->footage->name, "clip");
}

TEST_F(Footage, ARunTellsWhatBecameOfEveryFrame) {
  OpenClip();
  SetFrameIncluded(state, 1, false);
  RunIt();
  const FootageBoard& board = *state.steps.panorama->footage;
  EXPECT_EQ(StatusOf(board, 0), FrameStatus::kPlaced);
  EXPECT_EQ(StatusOf(board, 1), FrameStatus::kExcluded);
  EXPECT_EQ(StatusOf(board, 3), FrameStatus::kRejected);
  EXPECT_EQ(StatusOf(board, 5), FrameStatus::kSeparate);
  EXPECT_EQ(WordsOfFrame(board, 3), "Not placed: too few matches");
  ASSERT_EQ(WordsOfResult(board).size(), 3u);
  EXPECT_EQ(WordsOfResult(board)[0], "3 of 6 frames placed");
  EXPECT_EQ(WordsOfResult(board)[1], "Partial: 4 of 6 usable frames are in the panorama.");
  EXPECT_EQ(WordsOfResult(board)[2],
            "Frames fit to 0.50 px on average. Expected error: 1.0 px on average, 1.5 px at most. "
            "Drift: 0.2 px.");
  EXPECT_EQ(WarningsOfResult(board).at(0), "The clip is short.");
  EXPECT_EQ(board.selected, -1) << "the panorama is looked at";
  ASSERT_TRUE(board.mosaic);
  EXPECT_EQ(board.mosaic->width, 64);
}

TEST_F(Footage, AFrameThatIsTakenInAgainIsNotYetDecided) {
  OpenClip();
  SetFrameIncluded(state, 1, false);
  RunIt();
  SetFrameIncluded(state, 1, true);
  EXPECT_EQ(StatusOf(*state.steps.panorama->footage, 1), FrameStatus::kNotYet);
}

// A double click selects a frame and leaves it out: its reader has the session just then.
TEST_F(Footage, WhatIsLeftOutWhileAFrameIsReadIsKnownOnceItIsRead) {
  OpenClip();
  RunIt();
  FootageBoard& board = *state.steps.panorama->footage;
  SelectFrame(state, 0);
  board.next_stage.clear();
  {
    const std::lock_guard reader(board.session->mutex);
    SetFrameIncluded(state, 0, false);
  }
  EXPECT_EQ(board.next_stage, "");
  Settle();
  EXPECT_EQ(board.next_stage, "read") << "the made-up run left no products to go on from";
}

TEST_F(Footage, TheResultBecomesTheBackdropInOneStepThatIsUndone) {
  OpenClip();
  RunIt();
  EXPECT_FALSE(state.document().panorama) << "not before it is asked for";
  app::Run(state, "use-panorama");
  EXPECT_EQ(state.step, Step::kDepth);
  EXPECT_FALSE(ShowsFootage(state));
  ASSERT_TRUE(state.document().panorama);
  EXPECT_EQ(state.document().panorama->width, 64);
  // Alpha fades a border to nothing; its colours stay, as in the job's file: 200, not 200 · 200 /
  // 255.
  EXPECT_EQ(state.document().panorama->at(5, 5)[0], 200);
  const Projection& projection = state.document().scene.backdrop.projection;
  EXPECT_EQ(projection.type, ProjectionType::kGnomonic);
  EXPECT_EQ(projection.focal_px, 55.0);
  EXPECT_EQ(projection.centre_px, glm::dvec2(31.0, 23.0));
  const int steps = state.history.Position();
  app::Run(state, "use-panorama");
  EXPECT_EQ(state.history.Position(), steps) << "it is the backdrop already";
  app::Run(state, "undo");
  EXPECT_FALSE(state.document().panorama);
}

// A lens of 75 degrees from edge to edge of its round window.
Lens LensOf75Degrees() {
  Lens lens;
  lens.width = 720, lens.height = 576;
  lens.cx = 360, lens.cy = 288;
  lens.circle = {360, 288, 250};
  lens.field_of_view = RadiansFromDegrees(75);
  lens.focal_px = 250 / (2 * std::sin(lens.field_of_view / 4));
  return lens;
}

TEST_F(Footage, TheScopeOfTheSceneSeesAsWideAsTheClipsLens) {
  state.steps.panorama->makers->run = [](PanoramaSession& session, const PanoramaRequest& request,
                                         const PanoramaObserver& observer,
                                         const Progress& progress) {
    PanoramaResult result = MadeUpRun(session, request, observer, progress);
    result.report.lens = LensOf75Degrees();
    return result;
  };
  OpenClip();
  RunIt();
  app::Run(state, "use-panorama");
  EXPECT_NEAR(state.document().scene.scope.field_of_view, RadiansFromDegrees(75), 1e-12);
  EXPECT_EQ(state.document().lens, LensOf75Degrees());
  authoring::SaveDocument(state.document(), temp / "scene");
  const LoadedScene saved = LoadScene(temp / "scene");
  ASSERT_TRUE(saved.lens);
  EXPECT_NEAR(saved.lens->field_of_view, RadiansFromDegrees(75), 1e-9);
  EXPECT_EQ(saved.lens->circle, LensOf75Degrees().circle);
  EXPECT_NEAR(saved.scene.scope.field_of_view, RadiansFromDegrees(75), 1e-9);
  app::Run(state, "undo");
  EXPECT_EQ(state.document().scene.scope.field_of_view, ScopeSpec().field_of_view);
  EXPECT_FALSE(state.document().lens);
}

TEST_F(Footage, AGuessedLensGivesItsFieldOfViewAndTakesNoKnownLensAway) {
  authoring::Document document = NewDocument();
  TakeFootageLens(document, LensOf75Degrees(), true);
  EXPECT_NEAR(document.scene.scope.field_of_view, RadiansFromDegrees(75), 1e-12);
  EXPECT_FALSE(document.lens) << "a guess is no lens file";
  Lens known = LensOf75Degrees();
  known.field_of_view = RadiansFromDegrees(70);
  TakeFootageLens(document, known, false);
  TakeFootageLens(document, LensOf75Degrees(), true);
  EXPECT_EQ(document.lens, known);
  EXPECT_NEAR(document.scene.scope.field_of_view, RadiansFromDegrees(70), 1e-12);
}

TEST_F(Footage, AFailedRunIsOneSentenceAndWhatWasMadeStays) {
  OpenClip();
  RunIt();
  const auto made = state.steps.panorama->footage->made;
  state.steps.panorama->makers->run = [](PanoramaSession&, const PanoramaRequest&,
                                         const PanoramaObserver& observer,
                                         const Progress&) -> PanoramaResult {
    observer.frame(RowOf(0, false, "blank", -1), {});
    throw Error(Code::kBadImage, "nothing overlaps; move slowly", "clip");
  };
  SetFrameIncluded(state, 0, false);
  SetFrameIncluded(state, 0, true);
  state.steps.panorama->footage->next_stage = "register";  // something changed
  RunIt();
  ASSERT_EQ(state.dialogs.size(), 1u);
  EXPECT_EQ(std::get<ErrorDialog>(state.dialogs[0]).sentence,
            "clip: nothing overlaps; move slowly");
  EXPECT_EQ(state.steps.panorama->footage->made, made);
  EXPECT_EQ(StatusOf(*state.steps.panorama->footage, 0), FrameStatus::kPlaced);
}

TEST_F(Footage, StopEndsTheRunAndKeepsWhatWasMade) {
  OpenClip();
  RunIt();
  const auto made = state.steps.panorama->footage->made;
  state.steps.panorama->makers->run = [](PanoramaSession&, const PanoramaRequest&,
                                         const PanoramaObserver& observer,
                                         const Progress& progress) -> PanoramaResult {
    observer.frame(RowOf(0, false, "blank", -1), {});
    for (;;) {
      progress.Step("match", 0.5);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  };
  state.steps.panorama->footage->next_stage = "register";
  app::Run(state, "run-footage");
  for (int i = 0; i < 24000 && StatusOf(*state.steps.panorama->footage, 0) == FrameStatus::kPlaced;
       ++i) {
    FinishWork(state);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_TRUE(FootageIsUnderWay(state));
  EXPECT_FALSE(CanRun(state));
  state.jobs.Stop();
  Settle();
  EXPECT_TRUE(state.dialogs.empty());
  EXPECT_EQ(state.message, "Stopped.");
  EXPECT_EQ(state.steps.panorama->footage->made, made);
  EXPECT_EQ(StatusOf(*state.steps.panorama->footage, 0), FrameStatus::kPlaced);
}

TEST_F(Footage, TheSelectedFrameIsReadAtFullSizeAndWithoutTheLens) {
  OpenClip();
  Lens lens;
  lens.width = kWidth, lens.height = kHeight;
  lens.focal_px = 30, lens.cx = 19.5, lens.cy = 14.5;
  lens.field_of_view = 0.8;
  WriteLens(temp / "lens.json", lens);
  state.steps.panorama->footage->lenses.push_back(LensFromFile(temp / "lens.json"));
  SetFootageLens(state, 1);
  SelectFrame(state, 2);
  SetFrameView(state, FrameView::kRectified);
  state.steps.panorama->footage->compares = true;
  Settle();
  const FootageBoard& board = *state.steps.panorama->footage;
  ASSERT_EQ(board.large.frame, 2);
  EXPECT_EQ(board.large.problem, "");
  const Showing showing = ShowingOf(board);
  ASSERT_TRUE(showing.picture);
  ASSERT_TRUE(showing.before);
  EXPECT_FALSE(showing.is_stand_in);
  EXPECT_EQ(showing.before->at(20, 15)[0], 80);
  EXPECT_EQ(showing.picture->at(showing.picture->width / 2, showing.picture->height / 2)[0], 80);
}

TEST_F(Footage, ALensOfAnotherSizeIsToldBesideTheFrame) {
  OpenClip();
  Lens lens;
  lens.width = 800, lens.height = 640;
  lens.focal_px = 400, lens.cx = 400, lens.cy = 320;
  lens.field_of_view = 0.8;
  state.steps.panorama->footage->lenses.push_back({"other", "", lens});
  SetFootageLens(state, 1);
  Settle();
  EXPECT_NE(state.steps.panorama->footage->large.problem, "");
  EXPECT_TRUE(state.steps.panorama->footage->large.raw) << "as it came, it can be seen";
}

TEST_F(Footage, FramesAreWalkedThroughWithinTheClip) {
  OpenClip();
  EXPECT_EQ(state.steps.panorama->footage->selected, 0);
  StepFrame(state, -1);
  EXPECT_EQ(state.steps.panorama->footage->selected, 0);
  StepFrame(state, 100);
  EXPECT_EQ(state.steps.panorama->footage->selected, kFrames - 1);
  SelectFrame(state, -1);
  StepFrame(state, 1);
  EXPECT_EQ(state.steps.panorama->footage->selected, 0);
}

TEST_F(Footage, DeleteAndViewKeysDoNotReachTheSceneBehindTheBoard) {
  OpenClip();
  const double before = state.document().scene.scope.view_angle;
  app::Run(state, "view-70");
  EXPECT_EQ(state.document().scene.scope.view_angle, before);
  state.steps.panorama->shows_footage = false;
  app::Run(state, "view-70");
  EXPECT_NE(state.document().scene.scope.view_angle, before);
}

TEST(LensChoices, AreNoneAndThePresetsWhichFitTheRoundWindowOfTheClip) {
  EXPECT_EQ(LensChoices("/nowhere").size(), 1u);
  auto choices = LensChoices(fs::path(ARTHRO_SOURCE_DIR) / "resources" / "presets" / "lenses");
  ASSERT_GE(choices.size(), 2u);
  EXPECT_EQ(choices[0].words, "none");
  FitPresets(choices, 800, 640, {400, 320, 300});
  EXPECT_FALSE(choices[0].lens);
  for (std::size_t i = 1; i < choices.size(); ++i) {
    ASSERT_TRUE(choices[i].lens) << choices[i].problem;
    EXPECT_EQ(choices[i].lens->width, 800);
    EXPECT_EQ(choices[i].lens->circle.r, 300);
  }
  FitPresets(choices, 800, 640, {});
  EXPECT_FALSE(choices[1].lens);
  EXPECT_NE(choices[1].problem, "") << "without a round window nothing says where it ends";
}

TEST_F(Footage, APresetThatDoesNotFitTheClipIsRefusedInASentence) {
  state.steps.panorama->lens_folder =
      fs::path(ARTHRO_SOURCE_DIR) / "resources" / "presets" / "lenses";
  OpenClip();  // frames of one colour: there is no round window
  ASSERT_GE(state.steps.panorama->footage->lenses.size(), 2u);
  SetFootageLens(state, 1);
  EXPECT_EQ(state.steps.panorama->footage->lens, 0);
  ASSERT_EQ(state.dialogs.size(), 1u);
}

TEST(PictureZoom, TheWheelKeepsThePointUnderThePointer) {
  const glm::dvec2 frame(400, 300), picture(800, 400), pointer(120, 140);
  const auto under = [&](const PictureZoom& zoom) {
    const PicturePlace place = PlaceOf(zoom, frame, picture);
    return (pointer - place.corner) / place.size;
  };
  // Once the picture is higher than its frame, both axes can follow.
  PictureZoom zoom = Zoomed({}, 6, pointer, frame, picture);
  const glm::dvec2 before = under(zoom);
  zoom = Zoomed(zoom, 3, pointer, frame, picture);
  EXPECT_NEAR(under(zoom).x, before.x, 1e-12);
  EXPECT_NEAR(under(zoom).y, before.y, 1e-12);
}

TEST(PictureZoom, WhatIsShownStaysInsideThePicture) {
  const glm::dvec2 frame(400, 300), picture(800, 400);
  PictureZoom zoom = Zoomed({}, 10, {0, 0}, frame, picture);
  zoom = Dragged(zoom, {1e5, 1e5}, frame, picture);
  const PicturePlace place = PlaceOf(zoom, frame, picture);
  EXPECT_NEAR(place.corner.x, 0, 1e-9);
  EXPECT_NEAR(place.corner.y, 0, 1e-9);
  const PictureZoom all = Zoomed(zoom, -100, {10, 10}, frame, picture);
  EXPECT_EQ(all.zoom, 1);
  EXPECT_EQ(all.middle, glm::dvec2(0.5));
}

}  // namespace
}  // namespace arthro::app

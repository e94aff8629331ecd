// Previews of the file browser and pictures of the history, in the command layer, without a window.
#include "app/files/browse_preview.h"

#include <chrono>
#include <thread>

#include <gtest/gtest.h>

#include "app/editor/every_step.h"
#include "app/files/step_pictures.h"
#include "app/state/edits.h"
#include "simulation/core/atomic_file.h"
#include "simulation/scene/files/archive_io.h"
#include "simulation/scene/image_io.h"
#include "tests/support/measured_scene.h"
#include "tests/support/small_scene.h"
#include "tests/support/temp_folder.h"

namespace arthro::app {
namespace {

class BrowsePreviewTest : public testing::Test {
 protected:
  test::TempFolder temp;
};

TEST_F(BrowsePreviewTest, ShowsPicturesScenesAndArchives) {
  test::WriteSmallScene(temp / "knee");
  PackScene(temp / "knee", temp / "knee.arthro");
  const FilePreview picture = ReadFilePreview(temp / "knee" / "panorama.png");
  ASSERT_TRUE(picture.picture);
  EXPECT_EQ(picture.picture->width, BrowsePreview::kPictureSide);
  EXPECT_EQ(picture.picture->height, BrowsePreview::kPictureSide * 3 / 4);
  EXPECT_EQ(picture.words, "400 x 300 px");
  for (const char* place : {"knee", "knee.arthro", "knee/scene.json"}) {
    const FilePreview scene = ReadFilePreview(temp / place);
    EXPECT_TRUE(scene.picture) << place << ": " << scene.words;
    EXPECT_EQ(scene.words, "Small knee") << place;
  }
}

TEST_F(BrowsePreviewTest, SaysWhyADamagedFileHasNone) {
  WriteAtomically(temp / "broken.png", "no picture");
  WriteAtomically(temp / "broken.arthro", "no archive");
  WriteAtomically(temp / "empty.mp4", "");
  for (const char* file : {"broken.png", "broken.arthro", "empty.mp4"}) {
    const FilePreview preview = ReadFilePreview(temp / file);
    EXPECT_FALSE(preview.picture) << file;
    EXPECT_FALSE(preview.words.empty()) << file;
  }
  WriteAtomically(temp / "notes.txt", "x");
  EXPECT_EQ(ReadFilePreview(temp / "notes.txt").words, "");
}

TEST_F(BrowsePreviewTest, FollowsTheChosenEntryOfTheDialog) {
  WriteColourImage(temp / "a.png", ColourImage(40, 20));
  EditorState state = MakeEditorState(authoring::Document{});
  Browse(state, BrowseFor::kOpenFile, "Open", "Open", {{"All files", {}}}, {});
  auto& model = std::get<BrowseDialog>(state.dialogs.back()).model;
  model.GoTo(temp.path());
  model.Select(model.entries().front());
  const auto settle = [&] {
    for (int i = 0; i < 10000; ++i) {
      KeepBrowsePreviewFresh(state);
      if (!state.browsed->jobs.busy()) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  };
  settle();
  EXPECT_EQ(state.browsed->shown.words, "40 x 20 px");
  model.file_name.clear();
  settle();
  EXPECT_FALSE(state.browsed->shown.picture);
  EXPECT_EQ(state.browsed->shown.words, "");
  state.dialogs.clear();
  EXPECT_FALSE(KeepBrowsePreviewFresh(state)) << "nothing is read without a browser";
}

TEST(StepPictures, BelongToTheirStepAfterUndoAndRedo) {
  EditorState state = MakeEditorState(test::MeasuredDocument());
  ASSERT_TRUE(WantsStepPicture(state));
  ColourImage red(120, 120);
  for (std::size_t i = 0; i < red.rgb.size(); i += 3) red.rgb[i] = 200;
  KeepStepPicture(state, red);
  EXPECT_FALSE(WantsStepPicture(state)) << "one picture per step";
  Edit(state, "Turn", "", [](auto& next) { next.scene.title = "other"; });
  EXPECT_FALSE(StepPicture(state, 1));
  KeepStepPicture(state, ColourImage(120, 120));
  app::Run(state, "undo");
  ASSERT_TRUE(StepPicture(state, 0));
  EXPECT_EQ(StepPicture(state, 0)->width, kStepPictureSide);
  EXPECT_EQ(StepPicture(state, 0)->rgb[0], 200);
  EXPECT_EQ(StepPicture(state, 1)->rgb[0], 0);
}

}  // namespace
}  // namespace arthro::app

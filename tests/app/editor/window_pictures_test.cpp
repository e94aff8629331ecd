// The whole window as somebody looked at it, at a third of its size: where things are, what is
// drawn, how it reads. Of the demo scene, on the clock of a script; 1200x840 pixels hold every
// control of a practice.
#include <filesystem>

#include <gtest/gtest.h>

#include "simulation/scene/image_io.h"
#include "tests/support/build_paths.h"
#include "tests/support/compare_pictures.h"
#include "tests/support/run_window.h"

namespace arthro {
namespace {

constexpr int kShrink = 3;

// Means of squares of pixels.
ColourImage Shrunk(const ColourImage& image) {
  ColourImage small(image.width / kShrink, image.height / kShrink);
  for (int y = 0; y < small.height; ++y)
    for (int x = 0; x < small.width; ++x)
      for (int c = 0; c < 3; ++c) {
        int sum = 0;
        for (int i = 0; i < kShrink * kShrink; ++i)
          sum += image.at(kShrink * x + i % kShrink, kShrink * y + i / kShrink)[c];
        small.at(x, y)[c] =
            static_cast<std::uint8_t>((sum + kShrink * kShrink / 2) / (kShrink * kShrink));
      }
  return small;
}

class WindowPictures : public testing::Test {
 protected:
  void SetUp() override { ARTHRO_REQUIRE_XVFB(); }
  // Window after a script. The pointer rests where it highlights nothing.
  ColourImage Shoot(const std::string& job, const std::string& script) {
    const auto file = temp / "shot.png";
    const auto result =
        test::RunWindow(job + " " + ARTHRO_SOURCE_DIR + "/resources/demo --size 1200x840",
                        script + "\nhover Picture\nwait frames 10\nshot " + file.string() + "\n");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.exit_code == 0 ? Shrunk(ReadColourImage(file)) : ColourImage();
  }
  static void ExpectCaught(const ColourImage& wrong, const std::string& name) {
    const test::PictureDifference difference = test::DifferenceFromBaseline(wrong, name);
    EXPECT_TRUE(difference.comparable);
    EXPECT_FALSE(difference.passes()) << difference.Sentence();
  }
  test::TempFolder temp;
};

TEST_F(WindowPictures, TheEditorWithAScene) {
  EXPECT_TRUE(test::MatchesBaseline(Shoot("edit", "click Tissue"), "window_editor"));
  ExpectCaught(Shoot("edit", "click Tissue\nclick Material"), "window_editor");
}

TEST_F(WindowPictures, TheEditorWithNothing) {
  EXPECT_TRUE(test::MatchesBaseline(Shoot("edit", "click New"), "window_empty"));
  ExpectCaught(Shoot("edit", "click New\nclick Depth"), "window_empty");
}

TEST_F(WindowPictures, APractice) {
  EXPECT_TRUE(test::MatchesBaseline(Shoot("practise", "wait job\nkey o"), "window_practice"));
  ExpectCaught(Shoot("practise", "wait job\nkey o\nclick Upright"), "window_practice");
}

}  // namespace
}  // namespace arthro

// Composition of rendered clips under their exact homographies, against their plane.
#include <gtest/gtest.h>

#include "authoring/panorama/compose/compose.h"
#include "authoring/phantom/clip/clip.h"
#include "tests/support/panorama_score.h"

namespace arthro::authoring {
namespace {

test::PanoramaScore ComposeClip(ClipPreset preset, int frames, ComposeReport& report) {
  ClipOptions options = ClipOptionsOf(preset, 320, 256);
  options.frames = frames;
  const Clip clip(options);
  const Rectifier rectifier(clip.lens(), RectifyOptions{});
  std::vector<FrameResult> places(frames);
  for (int i = 0; i < frames; ++i) {
    places[i].index = i;
    places[i].is_placed = !clip.IsBlank(i);
    places[i].component = 0;
    places[i].panorama_from_rectified = clip.PanoramaFromRectified(i, rectifier.view());
  }
  const FrameSource source = [&, at = 0](int& index, cv::Mat& rgb) mutable {
    if (at == frames) {
      at = 0;
      return false;
    }
    index = at++;
    rgb = clip.Frame(index);
    return true;
  };
  const ComposedPanorama panorama = Compose(source, rectifier, places, {}, &report, {});
  return test::ScorePanorama(panorama.rgba, clip.Panorama(), panorama.composed_from_panorama);
}

// The thresholds are those of whole sequences of 800 x 640; these frames are smaller.
TEST(ComposeClip, EasyShowsThePlane) {
  ComposeReport report;
  const auto score = ComposeClip(ClipPreset::kEasy, 12, report);
  EXPECT_GE(score.psnr, 31);
  EXPECT_GE(score.ssim, 0.90);
  EXPECT_EQ(report.frames_contributing, 12);
}

TEST(ComposeClip, HardShowsThePlane) {
  ComposeReport report;
  const auto score = ComposeClip(ClipPreset::kHard, 12, report);
  EXPECT_GE(score.psnr, 25);
  EXPECT_GE(score.ssim, 0.75);
}

}  // namespace
}  // namespace arthro::authoring

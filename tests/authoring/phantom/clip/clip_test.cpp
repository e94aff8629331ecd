// The rendered clip: its truth agrees with its pixels, and every run gives the same bytes.
#include "authoring/phantom/clip/clip.h"

#include <cmath>
#include <cstring>
#include <ctime>
#include <thread>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "simulation/core/error.h"
#include "tests/support/panorama/clip_score.h"

namespace arthro::authoring {
namespace {

ClipOptions Small(ClipPreset preset = ClipPreset::kEasy, int frames = 6) {
  ClipOptions options = ClipOptionsOf(preset, 320, 256);
  options.frames = frames;
  return options;
}

// Evenly lit, sharp and without noise: a frame is then the panorama under a homography.
ClipOptions Plain() {
  ClipOptions options = Small();
  options.falloff = options.vignette = options.highlights = options.bumps = 0;
  options.flicker = options.noise = options.shot_noise = options.blur = 0;
  options.tilt = RadiansFromDegrees(12);
  options.roll = 1.0;
  options.zoom = 0.2;
  options.step = 0.5;
  return options;
}

RectifiedView ViewAround(const Clip& clip) {
  const double radius = clip.lens().focal_px * std::tan(clip.options().field_of_view / 2);
  const int size = 2 * static_cast<int>(std::ceil(radius)) + 4;
  return {size, size, clip.lens().focal_px, (size - 1) / 2.0, (size - 1) / 2.0};
}

// Raw pixel of each pixel of the rectified frame, by the formulas of lens.h again.
cv::Mat Rectified(const Clip& clip, const RectifiedView& view, const cv::Mat& raw, cv::Mat& mask) {
  const Lens& lens = clip.lens();
  cv::Mat map(view.height, view.width, CV_32FC2);
  mask = cv::Mat::zeros(view.height, view.width, CV_8U);
  for (int y = 0; y < view.height; ++y)
    for (int x = 0; x < view.width; ++x) {
      const double dx = x - view.cx, dy = y - view.cy, away = std::hypot(dx, dy);
      const double r = 2 * lens.focal_px * std::sin(std::atan(away / view.focal_px) / 2);
      const double k = away > 0 ? r / away : 1.0;
      map.at<cv::Vec2f>(y, x) =
          cv::Vec2f(static_cast<float>(lens.cx + k * dx), static_cast<float>(lens.cy + k * dy));
      mask.at<std::uint8_t>(y, x) = r < lens.circle.r - 4 ? 255 : 0;
    }
  cv::Mat rectified;
  cv::remap(raw, rectified, map, {}, cv::INTER_CUBIC);
  return rectified;
}

bool Same(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() &&
         std::memcmp(a.data, b.data, a.total() * a.elemSize()) == 0;
}

TEST(Clip, FrameIsThePanoramaSeenThroughItsTruth) {
  const Clip clip(Plain());
  const RectifiedView view = ViewAround(clip);
  cv::Mat panorama, grey, mask, predicted;
  cv::cvtColor(clip.Panorama(), panorama, cv::COLOR_RGB2GRAY);
  for (int i = 0; i < clip.frames(); ++i) {
    cv::cvtColor(Rectified(clip, view, clip.Frame(i), mask), grey, cv::COLOR_RGB2GRAY);
    const cv::Matx33d truth = clip.PanoramaFromRectified(i, view);
    // Correlation is highest at the true position, and lower a pixel away.
    const auto likeness = [&](double off_x, double off_y) {
      const cv::Matx33d moved = cv::Matx33d(1, 0, off_x, 0, 1, off_y, 0, 0, 1) * truth;
      cv::warpPerspective(panorama, predicted, moved, grey.size(),
                          cv::INTER_CUBIC | cv::WARP_INVERSE_MAP);
      cv::Mat a, b;
      cv::Laplacian(predicted, a, CV_32F, 3);  // fine texture only
      cv::Laplacian(grey, b, CV_32F, 3);
      cv::Mat inside;
      cv::erode(mask, inside, cv::Mat::ones(7, 7, CV_8U));
      a.setTo(0, inside == 0);
      b.setTo(0, inside == 0);
      return a.dot(b) / std::sqrt(a.dot(a) * b.dot(b));
    };
    const double at = likeness(0, 0);
    EXPECT_GT(at, 0.75) << i;  // both pictures are resampled, so their finest texture differs
    // The vertex of the parabola through three values is within a twentieth of a pixel of the
    // truth.
    for (const cv::Point2d& way : {cv::Point2d(1, 0), cv::Point2d(0, 1)}) {
      const double before = likeness(-way.x, -way.y), after = likeness(way.x, way.y);
      EXPECT_LT(std::abs(0.5 * (before - after) / (before - 2 * at + after)), 0.05) << i;
    }
  }
}

TEST(Clip, SameBytesInAnyOrderAndFromAnyThread) {
  const ClipOptions options = Small(ClipPreset::kHard, 4);
  const Clip clip(options), again(options);
  std::vector<cv::Mat> forward(4), backward(4);
  std::jthread other([&] {
    for (std::size_t i = 0; i < 4; ++i) forward[i] = clip.Frame(static_cast<int>(i));
  });
  for (std::size_t i = 4; i-- > 0;) backward[i] = again.Frame(static_cast<int>(i));
  other.join();
  for (std::size_t i = 0; i < 4; ++i) EXPECT_TRUE(Same(forward[i], backward[i])) << i;
  ClipOptions seeded = options;
  seeded.seed = 2;
  EXPECT_FALSE(Same(Clip(seeded).Frame(0), forward[0]));
}

TEST(Clip, EveryPresetRenders) {
  for (int p = 0; p <= static_cast<int>(ClipPreset::kLong); ++p) {
    ClipOptions options = ClipOptionsOf(static_cast<ClipPreset>(p), 160, 128);
    options.frames = std::min(options.frames, 8);
    const Clip clip(options);
    const cv::Mat frame = clip.Frame(options.frames / 2);
    const double light = cv::mean(frame, clip.window())[1];
    if (clip.IsBlank(options.frames / 2)) continue;
    EXPECT_GT(light, 60) << p;
    EXPECT_LT(light, 220) << p;
    EXPECT_EQ(cv::countNonZero(frame.reshape(1).rowRange(0, 1)), 0) << p;  // outside the window
  }
}

TEST(Clip, StillClipHasOneTruthAndAJumpBreaksIt) {
  const Clip still(Small(ClipPreset::kStill, 3)), jump(Small(ClipPreset::kJump, 10));
  const RectifiedView view = ViewAround(still);
  EXPECT_EQ(cv::norm(still.PanoramaFromRectified(0, view) - still.PanoramaFromRectified(2, view)),
            0);
  const auto step = [&](int i) { return cv::norm(jump.PoseOf(i).at - jump.PoseOf(i - 1).at); };
  EXPECT_GT(step(5), 0.9 * step(4) + 0.3 * jump.lens().circle.r);
}

TEST(Clip, BlankFramesAreRedAndAsManyAsAsked) {
  const Clip clip(Small(ClipPreset::kBlank, 24));
  int blank = 0;
  for (int i = 0; i < clip.frames(); ++i)
    if (clip.IsBlank(i)) {
      ++blank;
      const cv::Scalar colour = cv::mean(clip.Frame(i), clip.window());
      EXPECT_GT(colour[0], 1.5 * colour[1]);
    }
  EXPECT_EQ(blank, 4);
}

TEST(Clip, ShowsItsToolAndMarks) {
  ClipOptions options = Small(ClipPreset::kTool, 3);
  options.marks = true;
  const Clip clip(options);
  ClipOptions without = options;
  without.tool = without.marks = false;
  const Clip bare(without);
  cv::Mat differs, hidden = cv::max(clip.ToolMask(1), clip.MarksMask());
  cv::absdiff(clip.Frame(1), bare.Frame(1), differs);
  cv::Mat most;
  cv::reduce(differs.reshape(1, static_cast<int>(differs.total())), most, 1, cv::REDUCE_MAX);
  most = most.reshape(1, differs.rows);
  EXPECT_EQ(cv::countNonZero(most & (hidden == 0)), 0);
  EXPECT_GT(cv::countNonZero(clip.ToolMask(1) & clip.window()),
            cv::countNonZero(clip.window()) / 12);
}

TEST(Clip, RepeatedTextureRepeats) {
  ClipOptions options = Small();
  options.repeated = true;
  options.step = 1.2;
  const Clip clip(options);
  const cv::Mat panorama = clip.Panorama();
  const int tile = static_cast<int>(std::lround(3 * clip.lens().circle.r));
  ASSERT_GT(panorama.cols, tile + 50);
  EXPECT_EQ(
      cv::norm(panorama(cv::Rect(0, 0, 50, 50)), panorama(cv::Rect(tile, 0, 50, 50)), cv::NORM_INF),
      0);
}

TEST(Clip, FliesOverAGivenPicture) {
  cv::Mat picture(600, 800, CV_8UC3, cv::Scalar(10, 20, 30));
  cv::circle(picture, {400, 300}, 60, cv::Scalar(250, 120, 40), cv::FILLED);
  ClipOptions options = Plain();
  options.step = 0.1;
  const Clip clip(options, picture);
  EXPECT_EQ(clip.panorama_size(), picture.size());
  EXPECT_LE(cv::norm(clip.Panorama(), picture, cv::NORM_INF), 1);
  EXPECT_THROW(Clip(options, picture(cv::Rect(0, 0, 200, 200))), Error);
  EXPECT_THROW(Clip(options, cv::Mat(600, 800, CV_8U)), Error);
}

TEST(Clip, RefusesWhatCannotBe) {
  ClipOptions options = Small();
  options.frames = 0;
  EXPECT_THROW(Clip{options}, Error);
  options = Small();
  options.contrast = NAN;
  EXPECT_THROW(Clip{options}, Error);
  options = Small();
  options.field_of_view = RadiansFromDegrees(140);
  options.tilt = 0.5;
  EXPECT_THROW(Clip{options}, Error);
  const Clip clip(Small());
  EXPECT_THROW(clip.Frame(-1), Error);
  EXPECT_THROW(clip.Frame(clip.frames()), Error);
}

TEST(ClipScore, ForgivesThePlaneAndNothingElse) {
  const Clip clip(Small(ClipPreset::kEasy, 8));
  const RectifiedView view = ViewAround(clip);
  // Another plane: rotated, scaled and with a small perspective.
  const cv::Matx33d other(1.3, -0.4, 20, 0.4, 1.3, -30, 1e-5, 2e-5, 1);
  std::vector<FrameResult> results(8);
  for (int i = 0; i < 8; ++i) {
    auto& result = results[static_cast<std::size_t>(i)];
    result.index = i;
    result.is_placed = true;
    result.component = 0;
    result.expected_error_px = 0.1;
    result.panorama_from_rectified = other * clip.PanoramaFromRectified(i, view);
  }
  test::ClipScore score = test::ScoreClip(clip, view, results);
  EXPECT_EQ(score.right, 8);
  EXPECT_LT(score.max_px, 1e-3);
  EXPECT_EQ(score.covered, 1.0);
  // One frame 40 px off with a small expected error; one frame not placed.
  results[3].panorama_from_rectified =
      cv::Matx33d(1, 0, 40, 0, 1, 0, 0, 0, 1) * results[3].panorama_from_rectified;
  results[5].is_placed = false;
  score = test::ScoreClip(clip, view, results);
  EXPECT_EQ(score.placed, 7);
  EXPECT_EQ(score.right, 6);
  EXPECT_EQ(score.wrong_as_good, 1);
  EXPECT_LT(score.max_px, 1e-3) << score.Text();
  EXPECT_TRUE(std::isnan(score.worst_px[5]));
}

}  // namespace
}  // namespace arthro::authoring
